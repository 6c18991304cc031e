// SPDX-License-Identifier: Apache-2.0
#include "ride.h"

#include "tune.h"

#include <math.h>

void bench_ride_states(double out[BENCH_RIDE_STATES], const bike_sample *s) {
  out[0] = s->lean;
  out[1] = s->steer;
  out[2] = s->lean_rate;
  out[3] = s->steer_rate;
  out[4] = s->speed;
}

double bench_ride_error(const double actual[BENCH_RIDE_STATES],
                        const double expected[BENCH_RIDE_STATES]) {
  double worst = 0;
  for (int i = 0; i < BENCH_RIDE_STATES; i++) {
    double error = fabs(actual[i] - expected[i]);
    if (!(error <= worst)) worst = isnan(error) ? INFINITY : error;
  }
  return worst;
}

static int pass(const bike_sample *sample, const bike_sample_more *more, void *user) {
  (void)sample, (void)more, (void)user;
  return 0;
}

bool bench_ride_go(bike_ride_result *out, const bench_ride *ride) {
  const bench_subject *s = ride->subject;
  bike_ride_def def = bike_default_ride_def();
  def.start = s->ride_start;
  def.duration = def.sample = s->ride_time;
  def.rtol = def.atol = ride->tolerance;
  def.on_sample = pass;
  return !bike_ride(out, &s->model, &def) && out->complete;
}

void bench_rides(void *context, long repeats) {
  bike_ride_result result;
  for (long i = 0; i < repeats; i++) bench_ride_go(&result, context);
}

typedef struct tuning {
  bench_subject *subject;
  const double *end;
  double error;
} tuning;

static double tolerance_of(int k) {
  return pow(10, -k / 8.0);
}

static bool good(void *context, int k) {
  const tuning *t = context;
  bench_ride ride = {t->subject, tolerance_of(k)};
  bike_ride_result result;
  double states[BENCH_RIDE_STATES];
  if (!bench_ride_go(&result, &ride)) return false;
  bench_ride_states(states, &result.end);
  return bench_ride_error(states, t->end) <= t->error;
}

double bench_ride_tolerance(bench_subject *subject, const double end[BENCH_RIDE_STATES],
                            double error) {
  tuning t = {subject, end, error};
  // the same grid as that of scipy_peer.py
  int k = bench_loosest(good, &t, 8 * 5, 8 * 14);
  return k < 0 ? 0 : tolerance_of(k);
}
