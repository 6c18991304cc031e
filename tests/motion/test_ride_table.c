// SPDX-License-Identifier: Apache-2.0
// The tables of coefficients against the theory: an explicit method has order p when for every
// rooted tree t of at most p nodes  sum_i b_i Phi_i(t) = 1 / gamma(t)  (Butcher 1963; Hairer,
// Norsett, Wanner, Solving Ordinary Differential Equations I, theorem II.2.13). Stands on
// ride_table.c alone, with rates of its own.
#include "motion/ride_table.h"

#include <math.h>
#include <string.h>

#include "support/near.h"

enum { MAX_ORDER = 8, MAX_TREES = 200 }; // 1 + 1 + 2 + 4 + 9 + 20 + 48 + 115

typedef struct tree {
  int order;
  int branches, branch[MAX_ORDER - 1]; // indices of the trees on its root, never rising
} tree;

typedef struct forest {
  tree trees[MAX_TREES];
  int count;
} forest;

// All ways to hang trees of together `left` nodes, none after `last`, on the root of `partial`.
static void grow(forest *f, tree partial, int left, int last) {
  if (left == 0) {
    assert_true(f->count < MAX_TREES);
    f->trees[f->count++] = partial;
    return;
  }
  for (int i = last; i >= 0; i--) {
    if (f->trees[i].order > left) continue;
    tree next = partial;
    next.branch[next.branches++] = i;
    grow(f, next, left - f->trees[i].order, i);
  }
}

static void plant(forest *f) {
  f->count = 0;
  for (int order = 1; order <= MAX_ORDER; order++)
    grow(f, (tree){.order = order}, order - 1, f->count - 1);
}

// gamma(t) = order times the gammas of the branches
static double density(const forest *f, const tree *t) {
  double gamma = t->order;
  for (int i = 0; i < t->branches; i++) gamma *= density(f, &f->trees[t->branch[i]]);
  return gamma;
}

// Phi_i(t) = product over the branches of sum_j A_ij Phi_j(branch)
static void weights(double phi[RIDE_MAX_STAGES], const ride_table *table, const forest *f,
                    const tree *t) {
  for (int i = 0; i < table->stages; i++) phi[i] = 1;
  for (int k = 0; k < t->branches; k++) {
    double inner[RIDE_MAX_STAGES];
    weights(inner, table, f, &f->trees[t->branch[k]]);
    for (int i = 0; i < table->stages; i++) {
      double sum = 0;
      for (int j = 0; j < i; j++) sum += table->A[i][j] * inner[j];
      phi[i] *= sum;
    }
  }
}

// Largest defect of the conditions of one order.
static double defect(const ride_table *table, const double *b, const forest *f, int order) {
  double worst = 0;
  for (int n = 0; n < f->count; n++) {
    if (f->trees[n].order != order) continue;
    double phi[RIDE_MAX_STAGES], sum = 0;
    weights(phi, table, f, &f->trees[n]);
    for (int i = 0; i < table->stages; i++) sum += b[i] * phi[i];
    double gap = fabs(sum - 1 / density(f, &f->trees[n]));
    worst = gap <= worst ? worst : gap;
  }
  return worst;
}

static void methods_have_their_order(void **state) {
  (void)state;
  forest f;
  plant(&f);
  assert_int_equal(f.count, MAX_TREES);
  const ride_table *tables[] = {&RIDE_TABLE_8, &RIDE_TABLE_4};
  for (int i = 0; i < 2; i++) {
    const ride_table *t = tables[i];
    // sums of up to 13 terms of up to 17: rounding below 1e-14
    for (int p = 1; p <= t->order; p++) assert_below(defect(t, t->b, &f, p), 1e-14);
    for (int p = 1; p <= t->embedded_order; p++) assert_below(defect(t, t->d, &f, p), 1e-14);
    if (t->order < MAX_ORDER) assert_true(defect(t, t->b, &f, t->order + 1) > 1e-6);
  }
  // an estimate there must be: the embedded method does not share the next order
  assert_true(defect(&RIDE_TABLE_8, RIDE_TABLE_8.d, &f, 8) > 1e-6);
}

// c_i = sum_j A_ij, and nothing on or above the diagonal
static void stages_lie_where_they_are_evaluated(void **state) {
  (void)state;
  const ride_table *tables[] = {&RIDE_TABLE_8, &RIDE_TABLE_4};
  for (int n = 0; n < 2; n++)
    for (int i = 0; i < tables[n]->stages; i++) {
      double row = 0;
      for (int j = 0; j < i; j++) row += tables[n]->A[i][j];
      for (int j = i; j < RIDE_MAX_STAGES; j++) assert_true(tables[n]->A[i][j] == 0);
      assert_near(row, tables[n]->c[i], 1e-14);
    }
}

// y0 = exp(sin t)
int ride_rates(double dy[RIDE_SIZE], double t, const double y[RIDE_SIZE], ride_flow *flow) {
  (void)flow;
  memset(dy, 0, RIDE_SIZE * sizeof *dy);
  dy[0] = y[0] * cos(t);
  return t > 10 ? 1 : 0;
}

static void a_step_is_taken_as_the_table_says(void **state) {
  (void)state;
  ride_point from = {.t = 1, .y = {exp(sin(1.0))}}, out;
  double error[RIDE_SIZE];
  assert_int_equal(ride_table_step(&out, error, &RIDE_TABLE_8, &from, 1.1, NULL), 0);
  assert_true(out.t == 1.1);
  assert_near(out.y[0], exp(sin(1.1)), 1e-14); // 0.1^9 of a constant below 1e-6
  assert_true(error[0] != 0 && fabs(error[0]) < 1e-11);
  for (int i = 1; i < RIDE_SIZE; i++) assert_true(out.y[i] == 0 && error[i] == 0);
  assert_int_equal(ride_table_step(&out, NULL, &RIDE_TABLE_4, &from, 1.1, NULL), 0);
  assert_near(out.y[0], exp(sin(1.1)), 1e-6);
  from.t = 9.95;
  assert_int_equal(ride_table_step(&out, NULL, &RIDE_TABLE_4, &from, 10.05, NULL), 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(methods_have_their_order),
      cmocka_unit_test(stages_lie_where_they_are_evaluated),
      cmocka_unit_test(a_step_is_taken_as_the_table_says),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
