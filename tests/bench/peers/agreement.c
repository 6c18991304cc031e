// SPDX-License-Identifier: Apache-2.0
#include "agreement.h"

#include "../native.h"

#include <math.h>
#include <stdlib.h>

// Some thousand roundings, of which each side makes about that many.
static const double SYMPY_AGREES = 1e-12;

enum { STATES = 1000, NEEDED = STATES / 2 };

double acceleration_difference(const bike_acceleration *actual, const bike_acceleration *expected) {
  double scale =
      fmax(1, fmax(fabs(expected->lean), fmax(fabs(expected->steer), fabs(expected->speed))));
  double lean = fabs(actual->lean - expected->lean), steer = fabs(actual->steer - expected->steer);
  double speed = fabs(actual->speed - expected->speed);
  double worst = fmax(lean, fmax(steer, speed)) / scale;
  return isfinite(lean + steer + speed) ? worst : INFINITY; // fmax passes over NaN
}

static double within(unsigned short seed[3], double limit) {
  return limit * (2 * erand48(seed) - 1);
}

// Well inside the model of any bicycle, and far from upright.
static bike_state random_state(unsigned short seed[3]) {
  bike_state s;
  s.lean = within(seed, 0.6);
  s.steer = within(seed, 0.6);
  s.lean_rate = within(seed, 2);
  s.steer_rate = within(seed, 2);
  s.speed = within(seed, 8);
  return s;
}

bool sympy_agreement(bench_notes *notes, sympy_accelerator *accelerate, const sympy_bicycle *p,
                     const bench_subject *subject) {
  unsigned short seed[3] = {6, 1, 1990};
  double worst = 0;
  int compared = 0;
  for (int i = 0; i < STATES; i++) {
    bike_state state = random_state(seed);
    bike_acceleration ours, theirs;
    if (native_accelerate(&ours, &subject->model, &state)) continue; // outside the model
    if (!accelerate(&theirs, p, &state)) continue;
    worst = fmax(worst, acceleration_difference(&theirs, &ours));
    compared++;
  }
  bench_note_value(notes, "states", compared);
  bench_note_check(notes, "disagreement", worst, SYMPY_AGREES);
  return compared >= NEEDED || bench_note_reason(notes, "only %d states have an answer", compared);
}
