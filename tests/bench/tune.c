// SPDX-License-Identifier: Apache-2.0
#include "tune.h"

int bench_loosest(bench_good *good, void *context, int low, int high) {
  if (!good(context, high)) return -1;
  if (good(context, low)) return low;
  while (high - low > 1) {
    int middle = low + (high - low) / 2;
    if (good(context, middle))
      high = middle;
    else
      low = middle;
  }
  return high;
}
