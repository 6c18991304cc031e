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

double metrics_spread(const double *value, size_t count) {
  double low = NAN, high = NAN;
  for (size_t k = 0; k < count; k++) {
    if (isnan(value[k])) return NAN;
    if (k == 0 || value[k] < low) low = value[k];
    if (k == 0 || value[k] > high) high = value[k];
  }
  return high - low;
}
