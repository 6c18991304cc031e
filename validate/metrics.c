// SPDX-License-Identifier: Apache-2.0
#include "metrics.h"

#include <math.h>

metrics_peak metrics_scaled_max(const double *time, const double *error, size_t count,
                                double rate) {
  metrics_peak peak = {NAN, NAN};
  for (size_t k = 0; k < count; k++) {
    double size = fabs(error[k]) * exp(-rate * time[k]);
    if (isnan(size)) return (metrics_peak){NAN, time[k]};
    if (k == 0 || size > peak.value) peak = (metrics_peak){size, time[k]};
  }
  return peak;
}

metrics_peak metrics_max(const double *time, const double *error, size_t count) {
  return metrics_scaled_max(time, error, count, 0);
}

double metrics_rms(const double *error, size_t count) {
  double sum = 0;
  for (size_t k = 0; k < count; k++) sum += error[k] * error[k];
  return sqrt(sum / (double)count); // no data: NaN
}

void metrics_time_shift(double *shift, double *share, const double *error, const double *rate,
                        size_t count) {
  double ee = 0, er = 0, rr = 0;
  for (size_t k = 0; k < count; k++) {
    ee += error[k] * error[k];
    er += error[k] * rate[k];
    rr += rate[k] * rate[k];
  }
  *shift = -er / rr;
  *share = er * er / (ee * rr);
}

// The reference at a time between the first and the last.
static double value_at(const double *time, const double *value, size_t count, double at) {
  if (at <= time[0]) return value[0];
  if (at >= time[count - 1]) return value[count - 1];
  size_t low = 0, high = count - 1;
  while (high - low > 1) {
    size_t middle = (low + high) / 2;
    *(time[middle] <= at ? &low : &high) = middle;
  }
  double share = (at - time[low]) / (time[high] - time[low]);
  return value[low] + share * (value[high] - value[low]);
}

metrics_peak metrics_tube(const double *time, const double *reference, const double *value,
                          size_t count, double slack) {
  metrics_peak peak = {NAN, NAN};
  size_t first = 0;
  for (size_t k = 0; k < count; k++) {
    double early = value_at(time, reference, count, time[k] - slack);
    double late = value_at(time, reference, count, time[k] + slack);
    double low = fmin(early, late), high = fmax(early, late);
    while (time[first] < time[k] - slack) first++;
    for (size_t j = first; j < count && time[j] <= time[k] + slack; j++) {
      low = fmin(low, reference[j]);
      high = fmax(high, reference[j]);
    }
    double off = fmax(0, fmax(low - value[k], value[k] - high));
    if (isnan(value[k]) || isnan(reference[k])) return (metrics_peak){NAN, time[k]};
    if (k == 0 || off > peak.value) peak = (metrics_peak){off, time[k]};
  }
  return peak;
}

double metrics_spread(const double *value, size_t count) {
  double low = NAN, high = NAN;
  for (size_t k = 0; k < count; k++) {
    if (isnan(value[k])) return NAN;
    if (k == 0 || value[k] < low) low = value[k];
    if (k == 0 || value[k] > high) high = value[k];
  }
  return high - low;
}
