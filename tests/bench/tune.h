// SPDX-License-Identifier: Apache-2.0
// Equal measured error: the loosest setting of a method that is good enough.
#ifndef BICYCLE_BENCH_TUNE_H
#define BICYCLE_BENCH_TUNE_H

#include <stdbool.h>

// Whether the k-th setting of a grid, finer with larger k, is good enough.
typedef bool bench_good(void *context, int k);

// The smallest good k in low .. high by bisection, on the assumption that finer is better, which
// holds by and large; what is returned is good. -1 where even `high` is not.
int bench_loosest(bench_good *good, void *context, int low, int high);

#endif
