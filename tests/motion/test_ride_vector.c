// SPDX-License-Identifier: Apache-2.0
// The vectors of a ride do what SUNDIALS' own serial vectors do.
#include "motion/ride_flow.h"
#include "motion/ride_vector.h"
#include "support/near.h"

#include <stdlib.h>

enum { VECTORS = 13 };

typedef struct both {
  SUNContext context;
  N_Vector ours[VECTORS], theirs[VECTORS]; // the same numbers
  double data[RIDE_SIZE];
} both;

static double number(unsigned short seed[3]) {
  return 20 * erand48(seed) - 10;
}

static void open_both(both *b) {
  unsigned short seed[3] = {6, 7, 1990};
  assert_int_equal(SUNContext_Create(NULL, &b->context), 0);
  b->ours[0] = ride_vector_over(b->data, b->context);
  b->theirs[0] = N_VNew_Serial(RIDE_SIZE, b->context);
  for (int j = 1; j < VECTORS; j++) {
    b->ours[j] = N_VClone(b->ours[0]);
    b->theirs[j] = N_VClone(b->theirs[0]);
  }
  for (int j = 0; j < VECTORS; j++)
    for (int i = 0; i < RIDE_SIZE; i++)
      NV_Ith_S(b->ours[j], i) = NV_Ith_S(b->theirs[j], i) = number(seed);
}

static void close_both(both *b) {
  for (int j = 0; j < VECTORS; j++) {
    N_VDestroy(b->ours[j]);
    N_VDestroy(b->theirs[j]);
  }
  SUNContext_Free(&b->context);
}

// Thirteen products of numbers below 10, summed: some 1e3 roundings of 1e2 at the very most.
static void assert_same(N_Vector actual, N_Vector expected) {
  for (int i = 0; i < RIDE_SIZE; i++)
    assert_near(NV_Ith_S(actual, i), NV_Ith_S(expected, i), 1e-12);
}

static void sums_are_the_same(void **state) {
  (void)state;
  both b;
  open_both(&b);
  N_VLinearSum(2.5, b.ours[1], -0.75, b.ours[2], b.ours[3]);
  N_VLinearSum(2.5, b.theirs[1], -0.75, b.theirs[2], b.theirs[3]);
  assert_same(b.ours[3], b.theirs[3]);
  N_VLinearSum(1, b.ours[3], 3, b.ours[4], b.ours[4]); // in place
  N_VLinearSum(1, b.theirs[3], 3, b.theirs[4], b.theirs[4]);
  assert_same(b.ours[4], b.theirs[4]);
  N_VScale(-1.5, b.ours[5], b.ours[5]);
  N_VScale(-1.5, b.theirs[5], b.theirs[5]);
  assert_same(b.ours[5], b.theirs[5]);
  close_both(&b);
}

static void combinations_are_the_same(void **state) {
  (void)state;
  unsigned short seed[3] = {6, 8, 1990};
  for (int count = 1; count <= VECTORS; count++) {
    both b;
    open_both(&b);
    double c[VECTORS];
    for (int j = 0; j < count; j++) c[j] = j % 3 == 1 ? 0 : number(seed);
    N_VLinearCombination(count, c, b.ours, b.ours[0]); // in place, as integrators do
    N_VLinearCombination(count, c, b.theirs, b.theirs[0]);
    assert_same(b.ours[0], b.theirs[0]);
    close_both(&b);
  }
}

static void norms_are_the_same(void **state) {
  (void)state;
  both b;
  open_both(&b);
  double actual = N_VWrmsNorm(b.ours[1], b.ours[2]);
  assert_true(actual > 1);
  assert_near(actual, N_VWrmsNorm(b.theirs[1], b.theirs[2]), 1e-12);
  close_both(&b);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(sums_are_the_same),
                                     cmocka_unit_test(combinations_are_the_same),
                                     cmocka_unit_test(norms_are_the_same)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
