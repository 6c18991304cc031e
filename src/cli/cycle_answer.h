// SPDX-License-Identifier: Apache-2.0
// What `bicycle cycle` finds: the bifurcation, the weave mode around it, the branch of cycles, and
// those of one speed.
#ifndef BICYCLE_CLI_CYCLE_ANSWER_H
#define BICYCLE_CLI_CYCLE_ANSWER_H

#include "terminal/number.h"

#include <bicycle/cycle.h>
#include <stdbool.h>

// The weave mode is shown at these shares of the weave speed.
enum { CYCLE_MODES = 7 };
extern const double cycle_shares[CYCLE_MODES];

enum { CYCLE_MOST_AT_SPEED = 8 };

typedef struct cycle_answer {
  double weave; // m/s; NaN: none, and nothing else is set
  bike_hopf hopf;
  bike_weave_mode modes[CYCLE_MODES];
  bool has_mode[CYCLE_MODES];
  int count;
  bike_cycle *cycles; // rising amplitude
  double ended_at;    // rad: the first amplitude without a cycle; NaN: all found
  int at_speed_count; // cycles with the energy of riding straight at the speed asked for
  bike_cycle at_speed[CYCLE_MOST_AT_SPEED];
} cycle_answer;

// `search`: where to look for the first weave speed, m/s. `leans`: amplitudes, rad. `speed`, m/s,
// NaN if not asked for: its cycles up to the largest amplitude. An error of the library. Free it in
// any case.
int cycle_answer_find(cycle_answer *out, const bike_model *model, const double search[2],
                      const term_range *leans, double speed);
void cycle_answer_free(cycle_answer *answer);

#endif
