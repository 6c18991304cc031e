// SPDX-License-Identifier: Apache-2.0
#include "motion/cycle_half.h"

#include <bicycle/error.h>
#include <bicycle/ride.h>
#include <complex.h>
#include <math.h>

static int start_of(bike_state *out, const bike_model *model, const double x[HALF_SIZE],
                    double speed) {
  *out = (bike_state){.lean = x[HALF_LEAN],
                      .steer = x[HALF_STEER],
                      .lean_rate = x[HALF_LEAN_RATE],
                      .steer_rate = x[HALF_STEER_RATE]};
  return bike_speed_of_equal_energy(&out->speed, model, out, speed);
}

static int keep_last(const bike_sample *sample, const bike_sample_more *more, void *user) {
  (void)more;
  *(bike_sample *)user = *sample;
  return 0;
}

// A ride that ends early leaves the range in which the equations hold.
static int ride_to_end(const bike_model *model, const bike_ride_def *def) {
  bike_ride_result result;
  int code = bike_ride(&result, model, def);
  return code ? code : result.complete ? BIKE_OK : BIKE_ERROR_NO_CONVERGENCE;
}

int half_map(double out[HALF_SIZE], const bike_model *model, const double x[HALF_SIZE],
             double speed, double time) {
  if (!(time > 0)) return BIKE_ERROR_NO_CONVERGENCE;
  bike_sample end;
  bike_ride_def def = bike_default_ride_def();
  int code = start_of(&def.start, model, x, speed);
  if (code) return code == BIKE_ERROR_NOT_STATIONARY ? BIKE_ERROR_NO_CONVERGENCE : code;
  def.duration = def.sample = time;
  def.on_sample = keep_last;
  def.user = &end;
  code = ride_to_end(model, &def);
  if (code) return code;
  out[HALF_LEAN] = -end.lean;
  out[HALF_STEER] = -end.steer;
  out[HALF_LEAN_RATE] = -end.lean_rate;
  out[HALF_STEER_RATE] = -end.steer_rate;
  return BIKE_OK;
}

// Sums over half a period; the other half is the mirror image.
enum { SAMPLES = 256 }; // of a smooth periodic function: sums are exact to rounding
typedef struct tally {
  double half; // s
  int count;
  double speed;                         // sum
  double steer;                         // largest
  double complex lean_wave, steer_wave; // of the fundamental
} tally;

static int add_sample(const bike_sample *s, const bike_sample_more *more, void *user) {
  (void)more;
  tally *t = user;
  if (t->count++ == SAMPLES) return 0; // the end is the beginning of the other half
  double complex turn = cexp(-I * M_PI * s->time / t->half);
  t->speed += s->speed;
  t->steer = fmax(t->steer, fabs(s->steer));
  t->lean_wave += s->lean * turn;
  t->steer_wave += s->steer * turn;
  return 0;
}

int half_measure(bike_cycle *inout, const bike_model *model, const double x[HALF_SIZE]) {
  tally t = {.half = 0.5 * inout->period};
  bike_ride_def def = bike_default_ride_def();
  int code = start_of(&def.start, model, x, inout->speed);
  if (code) return code;
  def.sample = t.half / SAMPLES;
  def.duration = SAMPLES * def.sample;
  def.on_sample = add_sample;
  def.user = &t;
  code = ride_to_end(model, &def);
  if (code) return code;
  double complex steer_per_lean = t.steer_wave / t.lean_wave;
  double lag = -carg(steer_per_lean);
  inout->start = def.start;
  inout->mean_speed = t.speed / SAMPLES;
  inout->steer = t.steer;
  inout->ratio = cabs(steer_per_lean);
  inout->lag = lag < 0 ? lag + 2 * M_PI : lag;
  return BIKE_OK;
}
