// SPDX-License-Identifier: Apache-2.0
// A scenario played by its two engines: measured layer by layer, judged, explained.
#ifndef VALIDATE_COMPARISON_H
#define VALIDATE_COMPARISON_H

#include "gate.h"
#include "study.h"

enum { COMPARISON_LABEL = 24, COMPARISON_CAUSE = 1200 };

// One engine at work. The label is its name, or "reference" and "candidate" where both engines
// have the same name.
typedef struct comparison_side {
  const engine *engine;
  void *instance;
  char label[COMPARISON_LABEL];
  trace trace;
} comparison_side;

enum { REFERENCE, CANDIDATE };

// All limits hold: VERDICT_AGREE, or VERDICT_DIFFER where the convergence study has measured that
// the models differ and the scenario allows it (`expect: different-model`).
typedef enum verdict { VERDICT_AGREE, VERDICT_DIFFER, VERDICT_FAIL, VERDICT_INVALID } verdict;

// "agree", "differs as expected", "fail", "invalid".
const char *verdict_string(verdict v);
term_exit verdict_exit(verdict v);

// Told of progress within the scenario, 0..1.
typedef void comparison_progress(double share, void *user);

typedef struct comparison {
  const scenario *scenario;
  comparison_side side[2];
  double growth_rate; // 1/s  of scenario_growth, resolved
  double weight;      // N    of the bicycle with its rider
  bool ridden;        //      both traces are there
  int rides, played;  //      rides that the scenario takes, and those done: the progress

  measurement_list measurements;
  study_results study;
  gate_list gates;
  verdict verdict;
  const struct layer *first_failure; // NULL while all hold
  char cause[COMPARISON_CAUSE];      // one sentence, empty while all hold

  comparison_progress *progress; // may be NULL
  void *user;
} comparison;

// Creates both engines. The scenario must outlive the comparison. On a problem (TERM_USAGE: an
// engine cannot hold this bicycle) close it too.
term_exit comparison_open(comparison *c, const scenario *s, problem *p);
void comparison_close(comparison *c);

// Measures all layers and judges. TERM_DONE with a verdict, an invalid run included; TERM_USAGE
// where the scenario asks for what is impossible.
term_exit comparison_run(comparison *c, problem *p);

// Lets both engines ride, once; for the layers that look at rides.
term_exit comparison_ride(comparison *c, problem *p);

// Another ride of the same scenario: by engine `choice` from `start` into an empty trace.
term_exit comparison_ride_also(trace *out, comparison *c, const engine_choice *choice,
                               const bike_state *start, problem *p);

// Rows that both traces have.
size_t comparison_rows(const comparison *c);

// Rows of these that can be predicted: all, but for unstable rides (study_horizon).
size_t comparison_judged_rows(const comparison *c);

#endif
