// SPDX-License-Identifier: Apache-2.0
// Newton's method behind the search for turns has a bound on its work: a search that has no end
// runs into it.
#include "motion/turn_newton.h"
#include "support/near.h"

// x^2 = 2, y = 1
static int equations(double *f, double J[NEWTON_MAX][NEWTON_MAX], const double *x,
                     const void *user) {
  (void)user;
  f[0] = x[0] * x[0] - 2;
  f[1] = x[1] - 1;
  if (!J) return 0;
  J[0][0] = 2 * x[0];
  J[0][1] = J[1][0] = 0;
  J[1][1] = 1;
  return 0;
}

static void a_search_without_end_ends(void **state) {
  (void)state;
  const int longest_seen = 8406; // by a search for turns: far below the bound
  newton *solver = newton_create(2);
  assert_non_null(solver);
  double x[2] = {1.4, 1}, residual;
  int solved = 0;
  while (newton_solve(solver, x, &residual, equations, NULL) == 0) {
    assert_below(x[0] * x[0] - 2, 1e-14);
    solved++;
    assert_true(solved < 1000000);
  }
  assert_true(newton_spent(solver) && solved > 2 * longest_seen);
  x[0] = 1.4; // untouched from now on
  assert_int_equal(newton_solve(solver, x, &residual, equations, NULL), 1);
  assert_near(x[0], 1.4, 0);
  newton_free(solver);
  solver = newton_create(2);
  assert_false(newton_spent(solver));
  newton_free(solver);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_search_without_end_ends)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
