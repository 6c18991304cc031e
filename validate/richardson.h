// SPDX-License-Identifier: Apache-2.0
// Richardson's extrapolation: what a computation with steps h tends to as h goes to zero.
//
// With y(h) = y(0) + c_0 h^p + c_1 h^(p+1) + ... a combination of as many values as there are terms
// plus one removes these terms. (L. F. Richardson, Phil. Trans. R. Soc. A 210 (1911) 307-357)
#ifndef VALIDATE_RICHARDSON_H
#define VALIDATE_RICHARDSON_H

#include <stdbool.h>

enum { RICHARDSON_MAX = 8 };

// Weights of count <= RICHARDSON_MAX values with different steps h > 0: their sum is 1, and terms
// h^p ... h^(p + count - 2) cancel. False where the steps or p do not determine them.
bool richardson_weights(double weight[], const double step[], int count, double p);

// Least squares of log(error) over log(step): slope, and root mean square of what it leaves. NaN
// where an error is not positive.
void richardson_order(double *order, double *scatter, const double step[], const double error[],
                      int count);

#endif
