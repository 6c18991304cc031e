// SPDX-License-Identifier: Apache-2.0
#include "cycle_answer.h"

#include "terminal/progress.h"

#include <bicycle/error.h>
#include <bicycle/modes.h>
#include <bicycle/stability.h>
#include <complex.h>
#include <math.h>
#include <stdlib.h>

const double cycle_shares[CYCLE_MODES] = {0.6, 0.8, 0.9, 1, 1.1, 1.2, 1.4};

// Of the mode named weave at each speed; none where it is no oscillation.
static int find_modes(cycle_answer *out, const bike_model *model) {
  double speeds[CYCLE_MODES];
  bike_modes modes[CYCLE_MODES];
  for (int i = 0; i < CYCLE_MODES; i++) speeds[i] = cycle_shares[i] * out->weave;
  int code = bike_upright_modes(modes, model, speeds, CYCLE_MODES);
  for (int i = 0; i < CYCLE_MODES && !code; i++) {
    for (int k = 0; k < 4; k++) {
      double im = modes[i].values.im[k];
      if (modes[i].mode[k] != BIKE_MODE_WEAVE || !(im > 0)) continue;
      const double *re_part = modes[i].vectors_re[k], *im_part = modes[i].vectors_im[k];
      double complex steer_per_lean = (re_part[0] + I * im_part[0]) / (re_part[1] + I * im_part[1]);
      double lag = -carg(steer_per_lean);
      out->has_mode[i] = true;
      out->modes[i] = (bike_weave_mode){modes[i].values.re[k], im, cabs(steer_per_lean),
                                        lag < 0 ? lag + 2 * M_PI : lag};
    }
  }
  return code;
}

// Follows the cycles from small to large. An amplitude without a cycle ends it, want of memory all.
static int find_cycles(cycle_answer *out, const bike_model *model, const term_range *leans) {
  term_progress progress = {0};
  out->ended_at = NAN;
  out->cycles = calloc((size_t)leans->count, sizeof *out->cycles);
  if (!out->cycles) return BIKE_ERROR_MEMORY;
  int code = BIKE_OK;
  for (int i = 0; i < leans->count && !code; i++) {
    double lean = term_range_point(leans, i);
    term_progress_show(&progress, "cycles", (double)i / (double)leans->count);
    code = bike_cycle_find(&out->cycles[i], model, lean, out->weave,
                           i > 0 ? &out->cycles[i - 1] : NULL);
    if (code)
      out->ended_at = lean;
    else
      out->count++;
  }
  term_progress_clear(&progress);
  return code == BIKE_ERROR_MEMORY ? code : BIKE_OK;
}

// Looks between neighbours of the branch, the first of which is straight riding.
static int find_at_speed(cycle_answer *out, const bike_model *model, double speed) {
  const bike_cycle *before = NULL;
  double excess_before = out->weave - speed;
  int code = BIKE_OK;
  for (int i = 0; i < out->count && !code && out->at_speed_count < CYCLE_MOST_AT_SPEED; i++) {
    const bike_cycle *cycle = &out->cycles[i];
    double excess = cycle->speed - speed;
    if ((excess > 0) != (excess_before > 0)) {
      code = bike_cycle_of_speed(&out->at_speed[out->at_speed_count], model, speed, out->weave,
                                 before, cycle);
      if (!code) out->at_speed_count++;
    }
    before = cycle;
    excess_before = excess;
  }
  return code;
}

int cycle_answer_find(cycle_answer *out, const bike_model *model, const double search[2],
                      const term_range *leans, double speed) {
  bike_critical_speeds found;
  *out = (cycle_answer){.weave = NAN};
  int code = bike_upright_critical_speeds(&found, model, search[0], search[1]);
  if (code || found.weave_count == 0) return code;
  out->weave = found.weave[0];
  code = bike_hopf_at(&out->hopf, model, out->weave);
  if (!code) code = find_modes(out, model);
  if (!code) code = find_cycles(out, model, leans);
  return code || isnan(speed) ? code : find_at_speed(out, model, speed);
}

void cycle_answer_free(cycle_answer *answer) {
  free(answer->cycles);
}
