// SPDX-License-Identifier: Apache-2.0
// Random numbers that are functions of a counter and a key: no state, no order, no stream to split.
//
// Source: Philox4x32-10 of Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2,
// 3", SC11 (2011).
#ifndef SWEEP_PHILOX_H
#define SWEEP_PHILOX_H

#include <stdint.h>

void philox_bits(uint32_t out[4], const uint32_t counter[4], const uint32_t key[2]);

// Draw `stream` (>= 0) of point `index` (>= 0) for a seed: uniform in [0, 1), and normal with mean
// 0 and variance 1 (Box and Muller, 1958).
double philox_uniform(uint64_t seed, long index, int stream);
double philox_normal(uint64_t seed, long index, int stream);

#endif
