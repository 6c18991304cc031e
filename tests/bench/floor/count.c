// SPDX-License-Identifier: Apache-2.0
#include "floor.h"
#include "kernel_count.h"

// Of one sine with its cosine, which live in libm: the least it takes. Reduction by a multiple of
// pi/2 in three parts: a product, a rounding, three multiply-adds. Then the square, seven terms of
// each series to 2^-53 on |x| <= pi/4: six multiply-adds and two products, six and one.
static const double SINCOS_OPERATIONS = 5 + 6 + 1 + 2 * 12 + 3;
static const double SINCOS_INSTRUCTIONS = 5 + 1 + 12 + 3;

bool bench_count_kernel(bench_count *out) {
  double calls = BENCH_KERNEL_SINCOS;
  out->operations = BENCH_KERNEL_OPERATIONS + calls * SINCOS_OPERATIONS;
  out->instructions = BENCH_KERNEL_INSTRUCTIONS + calls * SINCOS_INSTRUCTIONS;
  return BENCH_KERNEL_OPERATIONS > 0 && BENCH_KERNEL_INSTRUCTIONS > 0;
}
