// SPDX-License-Identifier: Apache-2.0
// Draws: the published vectors, the moments, and that order does not matter.
#include "support/near.h"
#include "sweep/philox.h"

#include <string.h>

// Known answers of Random123 1.09 (kat_vectors, philox4x32 with 10 rounds), Salmon et al.
static void known_answers(void **state) {
  (void)state;
  static const struct {
    uint32_t counter[4], key[2], answer[4];
  } known[] = {
      {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
      {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
       {0xffffffff, 0xffffffff},
       {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
      {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
       {0xa4093822, 0x299f31d0},
       {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    uint32_t bits[4];
    philox_bits(bits, known[i].counter, known[i].key);
    assert_memory_equal(bits, known[i].answer, sizeof bits);
  }
}

enum { DRAWS = 200000 };

// Means and variances within five standard errors: 1/sqrt(12 n) and sqrt(1/180 n) of the uniform
// law, 1/sqrt(n) and sqrt(2/n) of the normal one.
static void moments(void **state) {
  (void)state;
  double sum[2] = {0}, squares[2] = {0}, cross = 0;
  for (long k = 0; k < DRAWS; k++) {
    const double u = philox_uniform(7, k, 0) - 0.5, z = philox_normal(7, k, 1);
    assert_true(u >= -0.5 && u < 0.5);
    sum[0] += u;
    squares[0] += u * u;
    sum[1] += z;
    squares[1] += z * z;
    cross += u * z;
  }
  const double n = DRAWS;
  assert_near(sum[0] / n, 0, 5 / sqrt(12 * n));
  assert_near(squares[0] / n, 1.0 / 12, 5 / sqrt(180 * n));
  assert_near(sum[1] / n, 0, 5 / sqrt(n));
  assert_near(squares[1] / n, 1, 5 * sqrt(2 / n));
  assert_near(cross / n, 0, 5 / sqrt(12 * n)); // streams know nothing of each other
}

static void every_argument_counts(void **state) {
  (void)state;
  const double one = philox_uniform(1, 1, 1);
  assert_true(philox_uniform(1, 1, 1) == one);
  assert_true(philox_uniform(2, 1, 1) != one);
  assert_true(philox_uniform(1, 2, 1) != one);
  assert_true(philox_uniform(1, 1, 2) != one);
  assert_true(philox_uniform(UINT64_C(1) << 40 | 1, 1, 1) != one);
  assert_true(philox_uniform(1, (1L << 40) + 1, 1) != one);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(known_answers),
      cmocka_unit_test(moments),
      cmocka_unit_test(every_argument_counts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
