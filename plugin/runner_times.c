// SPDX-License-Identifier: Apache-2.0
#include "runner_internal.h"

#include <math.h>
#include <time.h>

bool runner_divides(long *times, double whole, double part) {
  double ratio = whole / part;
  *times = lround(fmin(ratio, 1e15));
  return ratio < 1e15 && *times >= 1 && fabs(ratio - (double)*times) <= 1e-9 * ratio;
}

bool runner_check_times(double duration, double sample, double step, mjcf_error *error) {
  long times;
  if (!(duration > 0 && isfinite(duration)))
    return mjcf_fail(error, "the duration must be positive");
  if (!(sample > 0 && sample <= duration))
    return mjcf_fail(error, "the sample interval must be positive and at most the duration");
  if (!(step > 0 && isfinite(step)))
    return mjcf_fail(error, "the model's timestep must be positive");
  if (!runner_divides(&times, sample, step))
    return mjcf_fail(error, "the sample interval must be a multiple of the timestep");
  return runner_divides(&times, duration, step) ||
         mjcf_fail(error, "the duration must be a multiple of the timestep");
}

double runner_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
