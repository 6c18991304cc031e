// SPDX-License-Identifier: Apache-2.0
#include "motion/trace.h"

#include <math.h>
#include <stdlib.h>

#include "support/near.h"

void trace_free(trace *t) {
  free(t->sample);
  free(t->more);
  *t = (trace){0};
}

static int record(const bike_sample *sample, const bike_sample_more *more, void *user) {
  trace *t = user;
  if (t->count == t->room) {
    t->room = t->room ? 2 * t->room : 64;
    t->sample = realloc(t->sample, t->room * sizeof *t->sample);
    t->more = realloc(t->more, t->room * sizeof *t->more);
    assert_non_null(t->sample);
    assert_non_null(t->more);
  }
  t->sample[t->count] = *sample;
  t->more[t->count++] = *more;
  return t->stop_after && t->count >= t->stop_after;
}

bike_ride_def ride_def(trace *t, bike_state start, double duration, double sample) {
  bike_ride_def def = bike_default_ride_def();
  def.start = start;
  def.duration = duration;
  def.sample = sample;
  def.on_sample = record;
  def.user = t;
  return def;
}

int ride_into(bike_ride_result *result, const bike_model *model, const bike_ride_def *def) {
  ((trace *)def->user)->count = 0;
  return bike_ride(result, model, def);
}

bike_sample ride_end(const bike_model *model, const bike_ride_def *def) {
  bike_ride_result result;
  assert_int_equal(ride_into(&result, model, def), 0);
  assert_true(result.complete);
  trace *t = def->user;
  return t->sample[t->count - 1];
}

bike_state state_of_sample(const bike_sample *s) {
  return (bike_state){.lean = s->lean,
                      .steer = s->steer,
                      .lean_rate = s->lean_rate,
                      .steer_rate = s->steer_rate,
                      .speed = s->speed};
}

// The larger; a NaN, unlike with fmax, wins.
static double worse(double a, double b) {
  return b <= a ? a : b;
}

double energy_drift(const trace *t) {
  double worst = 0, start = t->sample[0].energy;
  for (size_t i = 0; i < t->count; i++) {
    double gap = fabs(t->sample[i].energy - start - t->more[i].work) / start;
    worst = worse(worst, gap / (t->sample[i].time + 1));
  }
  return worst;
}

double state_gap(const bike_sample *a, const bike_sample *b) {
  double gap[5] = {a->lean - b->lean, a->steer - b->steer, a->lean_rate - b->lean_rate,
                   a->steer_rate - b->steer_rate, a->speed - b->speed};
  double worst = 0;
  for (int i = 0; i < 5; i++) worst = worse(worst, fabs(gap[i]));
  return worst;
}
