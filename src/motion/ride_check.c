// SPDX-License-Identifier: Apache-2.0
#include "motion/ride_check.h"

#include <bicycle/error.h>
#include <float.h>
#include <math.h>

// Counts of intervals and steps are ratios of decimal fractions such as 0.3 / 0.1: off by rounding,
// never by this much.
static const double RATIO_SLACK = 1e-9;

bike_ride_def bike_default_ride_def(void) {
  return (bike_ride_def){
      .method = BIKE_METHOD_RK8,
      // Energy is to drift by less than 1e-13 a second and traces to stay within 1e-11 rad for
      // 10 s: a step every 10 to 50 ms may then err by 1e-13 at most. At 1e-13 the order 8 method
      // already works at the rounding of double; tighter only costs steps.
      .rtol = 1e-13,
      .atol = 1e-13, // of states that are of the order of 1 rad, 1 m, 1 m/s
      .step = 1e-3,
      .friction_limit = 1,                               // dry asphalt holds about that
      .lean_limit = 80 * (3.14159265358979323846 / 180), // lying flat, where 1/cos(lean) ends all
  };
}

long ride_intervals(const bike_ride_def *def) {
  return (long)floor(def->duration / def->sample + RATIO_SLACK);
}

static bool positive(double x) {
  return isfinite(x) && x > 0;
}

static bool divides(double step, double sample) {
  double ratio = sample / step;
  return ratio >= 1 - RATIO_SLACK && fabs(ratio - round(ratio)) <= RATIO_SLACK * ratio;
}

static bool breakpoints_rise(const bike_ride_def *def) {
  if (def->breakpoint_count > 0 && !def->breakpoints) return false;
  for (size_t i = 0; i < def->breakpoint_count; i++) {
    if (!isfinite(def->breakpoints[i])) return false;
    if (i > 0 && !(def->breakpoints[i] > def->breakpoints[i - 1])) return false;
  }
  return true;
}

static const char *wrong_times(const bike_ride_def *def) {
  if (!positive(def->duration)) return "duration must be positive";
  if (!positive(def->sample)) return "sample must be positive";
  if (!(def->duration / def->sample >= 1 - RATIO_SLACK))
    return "sample must not be longer than duration";
  // Beyond, neighbouring times drown in the rounding of the time.
  if (!(def->duration / def->sample <= 1e9))
    return "sample must be at least a billionth of the duration";
  return NULL;
}

static const char *wrong_method(const bike_ride_def *def) {
  switch (def->method) {
  case BIKE_METHOD_RK8:
  case BIKE_METHOD_ADAMS:
    // No step can be more accurate than rounding lets it be.
    if (!(isfinite(def->rtol) && def->rtol >= 4 * DBL_EPSILON))
      return "rtol must be at least 8.9e-16";
    return positive(def->atol) ? NULL : "atol must be positive";
  case BIKE_METHOD_RK4:
    if (!positive(def->step)) return "step must be positive";
    return divides(def->step, def->sample) ? NULL
                                           : "step must divide sample, the time between rows";
  }
  return "method is none of them";
}

static bool finite_start(const bike_state *s) {
  return isfinite(s->lean) && isfinite(s->steer) && isfinite(s->lean_rate) &&
         isfinite(s->steer_rate) && isfinite(s->speed);
}

const char *bike_ride_broken_rule(const bike_ride_def *def) {
  const char *wrong = wrong_times(def);
  if (!wrong) wrong = wrong_method(def);
  if (wrong) return wrong;
  if (!(def->lean_limit > 0 && def->lean_limit <= 1.5707963267948966)) // pi/2
    return "lean_limit must lie in 0 to 90 deg";
  if (!positive(def->friction_limit)) return "friction_limit must be positive";
  if (!breakpoints_rise(def)) return "breakpoints must be finite and rise";
  return def->on_sample ? NULL : "on_sample is missing";
}

int ride_check(const bike_ride_def *def) {
  if (bike_ride_broken_rule(def)) return BIKE_ERROR_ARGUMENT;
  return finite_start(&def->start) ? BIKE_OK : BIKE_ERROR_NOT_FINITE;
}
