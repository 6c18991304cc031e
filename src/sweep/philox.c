// SPDX-License-Identifier: Apache-2.0
#include "philox.h"

#include <math.h>

enum {
  ROUNDS = 10
}; // the fewest that pass BigCrush are 7 (table 2 of the paper); 10 is its choice

void philox_bits(uint32_t out[4], const uint32_t counter[4], const uint32_t key[2]) {
  uint32_t c0 = counter[0], c1 = counter[1], c2 = counter[2], c3 = counter[3];
  uint32_t k0 = key[0], k1 = key[1];
  for (int i = 0; i < ROUNDS; i++) {
    const uint64_t a = (uint64_t)UINT32_C(0xD2511F53) * c0, b = (uint64_t)UINT32_C(0xCD9E8D57) * c2;
    c0 = (uint32_t)(b >> 32) ^ c1 ^ k0;
    c1 = (uint32_t)b;
    c2 = (uint32_t)(a >> 32) ^ c3 ^ k1;
    c3 = (uint32_t)a;
    k0 += UINT32_C(0x9E3779B9); // Weyl sequences: the golden ratio and sqrt(3) - 1
    k1 += UINT32_C(0xBB67AE85);
  }
  out[0] = c0;
  out[1] = c1;
  out[2] = c2;
  out[3] = c3;
}

// Two numbers in [0, 1), each of 53 bits.
static void draw(double out[2], uint64_t seed, long index, int stream) {
  const uint64_t k = (uint64_t)index;
  const uint32_t counter[4] = {(uint32_t)k, (uint32_t)(k >> 32), (uint32_t)stream, 0};
  const uint32_t key[2] = {(uint32_t)seed, (uint32_t)(seed >> 32)};
  uint32_t bits[4];
  philox_bits(bits, counter, key);
  for (int i = 0; i < 2; i++) {
    const uint64_t both = (uint64_t)bits[2 * i + 1] << 32 | bits[2 * i];
    out[i] = (double)(both >> 11) * 0x1p-53;
  }
}

double philox_uniform(uint64_t seed, long index, int stream) {
  double u[2];
  draw(u, seed, index, stream);
  return u[0];
}

double philox_normal(uint64_t seed, long index, int stream) {
  double u[2];
  draw(u, seed, index, stream);
  return sqrt(-2 * log(1 - u[0])) * cos(2 * M_PI * u[1]); // 1 - u is never zero
}
