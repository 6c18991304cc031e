// SPDX-License-Identifier: Apache-2.0
// The cubic spline through points: twice continuously differentiable.
#ifndef FILES_SPLINE_H
#define FILES_SPLINE_H

#include <stddef.h>

// Second derivatives at the n >= 2 knots t (strictly rising) of the spline through y. End condition
// not-a-knot (the first two and the last two intervals share one cubic), which keeps the order of
// accuracy up to the ends; a parabola for n = 3, a line for n = 2. `scratch` has room for 2 n.
void bike_spline_fit(double *second, const double *t, const double *y, size_t n, double *scratch);

// Value, first and second derivative at `time` within the interval t[i], t[i + 1].
void bike_spline_at(double out[3], double time, const double *t, const double *y,
                    const double *second, size_t i);

#endif
