// SPDX-License-Identifier: Apache-2.0
// Built for the machine at hand and without vectorising: each line of the loop is one scalar
// instruction.
#include "floor.h"

#include <math.h>

bool bench_fma_known(void) {
#ifdef __FP_FAST_FMA
  return true;
#else
  return false;
#endif
}

static volatile double sink; // keeps results alive

// More than any core of today needs to keep its units busy (two units, latency 4: eight).
enum { CHAINS = 12 };

void bench_fma_chains(double count) {
  static volatile double factor = 0.999999, addend = 1e-6;
  const double f = factor, d = addend;
  double a = d, b = f, c = 1, e = 2, g = 3, h = 4, i = 5, j = 6, k = 7, l = 8, m = 9, n = 10;
  for (long loop = (long)ceil(count / CHAINS); loop > 0; loop--) {
    a = fma(a, f, d);
    b = fma(b, f, d);
    c = fma(c, f, d);
    e = fma(e, f, d);
    g = fma(g, f, d);
    h = fma(h, f, d);
    i = fma(i, f, d);
    j = fma(j, f, d);
    k = fma(k, f, d);
    l = fma(l, f, d);
    m = fma(m, f, d);
    n = fma(n, f, d);
  }
  sink = a + b + c + e + g + h + i + j + k + l + m + n;
}
