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

// The same with as many numbers side by side as a register of the lanes holds.
#define VECTOR_CHAINS(name, lanes)                                                                 \
  static void name(long loops) {                                                                   \
    typedef double wide __attribute__((vector_size((lanes) * sizeof(double))));                    \
    static volatile double factor = 0.999999, addend = 1e-6;                                       \
    const wide f = (wide){0} + factor, d = (wide){0} + addend;                                     \
    wide a = d, b = f, c = a + 1, e = a + 2, g = a + 3, h = a + 4;                                 \
    wide i = a + 5, j = a + 6, k = a + 7, l = a + 8, m = a + 9, n = a + 10;                        \
    for (; loops > 0; loops--) {                                                                   \
      a = a * f + d, b = b * f + d, c = c * f + d, e = e * f + d;                                  \
      g = g * f + d, h = h * f + d, i = i * f + d, j = j * f + d;                                  \
      k = k * f + d, l = l * f + d, m = m * f + d, n = n * f + d;                                  \
    }                                                                                              \
    wide sum = a + b + c + e + g + h + i + j + k + l + m + n;                                      \
    sink = sum[0] + sum[(lanes)-1];                                                                \
  }

VECTOR_CHAINS(chains_of_8, 8)
VECTOR_CHAINS(chains_of_4, 4)
VECTOR_CHAINS(chains_of_2, 2)

void bench_fma_vector_chains(double count, int lanes) {
  long loops = (long)ceil(count / CHAINS);
  if (lanes == 8)
    chains_of_8(loops);
  else if (lanes == 4)
    chains_of_4(loops);
  else
    chains_of_2(loops);
}
