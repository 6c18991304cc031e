// SPDX-License-Identifier: Apache-2.0
// The tables of coefficients, on Kepler's ellipse and a solution that depends on time: errors fall
// with the order the tables claim. Stands on ride_table.c alone, with rates of its own.
#include "motion/ride_table.h"

#include <math.h>
#include <string.h>

#include "support/near.h"

// y0, y1 on an ellipse with velocity y2, y3; y4 = exp(sin t); the rest at rest.
int ride_rates(double dy[RIDE_SIZE], double t, const double y[RIDE_SIZE], ride_flow *flow) {
  (void)flow;
  double r = hypot(y[0], y[1]), r3 = r * r * r;
  memset(dy, 0, RIDE_SIZE * sizeof *dy);
  dy[0] = y[2];
  dy[1] = y[3];
  dy[2] = -y[0] / r3;
  dy[3] = -y[1] / r3;
  dy[4] = y[4] * cos(t);
  return 0;
}

static const double ECCENTRICITY = 0.1;

static ride_point perihelion(void) {
  double e = ECCENTRICITY;
  return (ride_point){.y = {1 - e, 0, 0, sqrt((1 + e) / (1 - e)), 1}};
}

// After one period everything is where it was.
static double error_after_a_period(const ride_table *table, int steps) {
  ride_point p = perihelion(), start = p;
  double period = 2 * 3.14159265358979323846;
  for (int i = 1; i <= steps; i++) {
    ride_point from = p;
    assert_int_equal(ride_table_step(&p, NULL, table, &from, period * i / steps, NULL), 0);
  }
  double worst = 0;
  for (int i = 0; i < 5; i++) worst = fmax(worst, fabs(p.y[i] - start.y[i]));
  return worst;
}

static void steps_have_their_order(void **state) {
  (void)state;
  // coarse enough that no error drowns in rounding, fine enough that the leading term rules
  struct {
    const ride_table *table;
    int steps;
    double tolerance;
  } cases[] = {{&RIDE_TABLE_8, 48, 0.4}, {&RIDE_TABLE_4, 400, 0.1}};
  for (int i = 0; i < 2; i++) {
    double coarse = error_after_a_period(cases[i].table, cases[i].steps);
    double fine = error_after_a_period(cases[i].table, 2 * cases[i].steps);
    print_message("order %d: measured %.2f (%.1e, %.1e)\n", cases[i].table->order,
                  log2(coarse / fine), coarse, fine);
    assert_near(log2(coarse / fine), cases[i].table->order, cases[i].tolerance);
  }
}

// The embedded step has order 7: the estimate falls with the eighth power of the step.
static double estimate(double h) {
  ride_point out, from = perihelion();
  double error[RIDE_SIZE], worst = 0;
  assert_int_equal(ride_table_step(&out, error, &RIDE_TABLE_8, &from, h, NULL), 0);
  for (int i = 0; i < 5; i++) worst = fmax(worst, fabs(error[i]));
  return worst;
}

static void error_estimate_has_its_order(void **state) {
  (void)state;
  double order = log2(estimate(0.2) / estimate(0.1)) - 1;
  print_message("embedded order %d: measured %.2f\n", RIDE_TABLE_8.embedded_order, order);
  assert_near(order, RIDE_TABLE_8.embedded_order, 0.4);
}

// sum b = sum d = 1 and sum_j A_ij = c_i, to the rounding of the published fractions
static void rows_add_up(void **state) {
  (void)state;
  const ride_table *tables[] = {&RIDE_TABLE_8, &RIDE_TABLE_4};
  for (int n = 0; n < 2; n++) {
    const ride_table *t = tables[n];
    double b = 0, d = 0;
    for (int i = 0; i < t->stages; i++) {
      double row = 0;
      for (int j = 0; j < i; j++) row += t->A[i][j];
      for (int j = i; j < RIDE_MAX_STAGES; j++) assert_true(t->A[i][j] == 0);
      assert_near(row, t->c[i], 1e-14);
      b += t->b[i];
      d += t->d[i];
    }
    assert_near(b, 1, 1e-15);
    assert_near(d, t->embedded_order ? 1 : 0, 1e-15);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(steps_have_their_order),
      cmocka_unit_test(error_estimate_has_its_order),
      cmocka_unit_test(rows_add_up),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
