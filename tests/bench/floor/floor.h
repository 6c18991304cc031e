// SPDX-License-Identifier: Apache-2.0
// The floor of a scalar right-hand side: its arithmetic at the rate at which this machine does
// independent fused multiply-adds of doubles.
//
// Two counts are taken from the kernel's machine code (count.sh):
//   operations    compiled without fused multiply-adds: every +, -, *, / and square root is one
//   instructions  compiled with them: an instruction that multiplies and adds is one
// The floor that is asked about is the second, the lower one: no scalar code of these formulas gets
// under it. Quotients and square roots count like products though they cost more, and nothing is
// added for loads, stores and moves. Lanes do the same instructions with vectors.
#ifndef BICYCLE_BENCH_FLOOR_H
#define BICYCLE_BENCH_FLOOR_H

#include <stdbool.h>

typedef struct bench_count {
  double operations, instructions; // of one right-hand side, sines and cosines included
} bench_count;

// False where this machine's code could not be counted.
bool bench_count_kernel(bench_count *out);

// Whether this machine has scalar fused multiply-adds.
bool bench_fma_known(void);

// That many scalar fused multiply-adds (rounded up to a dozen), in a dozen independent chains.
void bench_fma_chains(double count);

// The same with vectors of 8, 4 or 2 numbers, each one instruction.
void bench_fma_vector_chains(double count, int lanes);

#endif
