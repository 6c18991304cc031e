// SPDX-License-Identifier: Apache-2.0
// Numbers that sum up how far two rides, or a ride and a law of physics, lie apart.
// A NaN among the data makes the metric NaN, which no limit lets pass.
#ifndef VALIDATE_METRICS_H
#define VALIDATE_METRICS_H

#include <stddef.h>

// A largest absolute value and where it stands.
typedef struct metrics_peak {
  double value; // of the data's unit; NaN if any is NaN
  double time;  // s, of the first such point; NaN without data
} metrics_peak;

metrics_peak metrics_max(const double *time, const double *error, size_t count);

// Largest |error| exp(-rate t), rate in 1/s: what is left when an instability that amplifies every
// difference with exp(rate t) is divided out. Rate 0: metrics_max.
metrics_peak metrics_scaled_max(const double *time, const double *error, size_t count, double rate);

// Root of the mean square.
double metrics_rms(const double *error, size_t count);

// The shift in time that explains most of an error, from the rate of the signal: with
// error = -shift rate + rest the rest is smallest (least squares). `share` of the mean square is
// explained; both NaN where nothing differs or nothing moves.
void metrics_time_shift(double *shift, double *share, const double *error, const double *rate,
                        size_t count);

// Largest distance of a value from all that the reference takes on within +-`slack` (s) of its
// time, the reference running straight between its points. Slack 0: metrics_max of the difference.
metrics_peak metrics_tube(const double *time, const double *reference, const double *value,
                          size_t count, double slack);

// Largest minus smallest value.
double metrics_spread(const double *value, size_t count);

#endif
