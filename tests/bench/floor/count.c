// SPDX-License-Identifier: Apache-2.0
#include "floor.h"
#include "kernel_count.h"

// Of one sine with its cosine, which live in libm: the least it takes.
//   reduction by a multiple of pi/2 in three parts: a product, a rounding, 3 multiply-adds
//   z = x^2: a product
//   sin x = x + (x z) P(z), P of degree 5 (as in fdlibm): 5 multiply-adds, a product, one more
//   cos x = (1 - z/2) + z^2 Q(z), Q of degree 5: 5 multiply-adds, a product, two more
static const double SINCOS_MULTIPLY_ADDS = 3 + 6 + 7, SINCOS_OTHERS = 2 + 1 + 1 + 1;

bool bench_count_kernel(bench_count *out) {
  double calls = BENCH_KERNEL_SINCOS;
  out->operations = BENCH_KERNEL_OPERATIONS + calls * (2 * SINCOS_MULTIPLY_ADDS + SINCOS_OTHERS);
  out->instructions = BENCH_KERNEL_INSTRUCTIONS + calls * (SINCOS_MULTIPLY_ADDS + SINCOS_OTHERS);
  return BENCH_KERNEL_OPERATIONS > 0 && BENCH_KERNEL_INSTRUCTIONS > 0;
}
