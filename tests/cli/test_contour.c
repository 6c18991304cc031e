// SPDX-License-Identifier: Apache-2.0
// Contours and shaded regions of functions whose contours are known.
#include "cli/figures/contour.h"
#include "support/near.h"

#include <string.h>

enum { NX = 23, NY = 17 };

typedef struct field {
  double x[NX], y[NY], value[NX * NY];
  bool torn[NX * NY];
  contour_grid grid;
} field;

// x from 0 to 2, y from 0 to 1.
static void fill(field *f, double (*function)(double x, double y)) {
  memset(f, 0, sizeof *f);
  for (int i = 0; i < NX; i++) f->x[i] = 2.0 * i / (NX - 1);
  for (int j = 0; j < NY; j++) f->y[j] = 1.0 * j / (NY - 1);
  for (int j = 0; j < NY; j++)
    for (int i = 0; i < NX; i++) f->value[j * NX + i] = function(f->x[i], f->y[j]);
  f->grid = (contour_grid){NX, NY, f->x, f->y, f->value, f->torn};
}

static double slope(double x, double y) {
  return x + 0.7 * y;
}

static double bowl(double x, double y) {
  return hypot(x - 1, 2 * (y - 0.5));
}

static void add_area(const plot_point *p, int count, void *user) {
  double area = 0;
  for (int k = 0; k < count; k++) {
    const plot_point *a = &p[k], *b = &p[(k + 1) % count];
    area += 0.5 * (a->x * b->y - b->x * a->y);
  }
  assert_true(area >= 0); // anticlockwise
  *(double *)user += area;
}

static double area_below(const field *f, double level) {
  double area = 0;
  contour_below(&f->grid, level, add_area, &area);
  return area;
}

// The region below a plane is a trapezium, and the polygons cover it once.
static void regions_are_covered_once(void **state) {
  (void)state;
  field f;
  fill(&f, slope);
  for (double level = 0.7; level < 2; level += 0.13)
    assert_near(area_below(&f, level), level - 0.35, 1e-12);
  assert_near(area_below(&f, 0), 0, 0);
  assert_near(area_below(&f, 5), 2, 1e-12);
  // an ellipse, to the grid
  fill(&f, bowl);
  assert_relative(area_below(&f, 0.8), M_PI * 0.8 * 0.4, 0.01);
}

static void holes_and_tears_are_left_out(void **state) {
  (void)state;
  const double cell = 2.0 / (NX - 1) / (NY - 1);
  field f;
  fill(&f, slope);
  f.torn[5 * NX + 7] = true;
  assert_near(area_below(&f, 5), 2 - cell, 1e-12);
  f.value[9 * NX + 4] = NAN; // the corner of four cells
  assert_near(area_below(&f, 5), 2 - 5 * cell, 1e-12);
}

typedef struct trace {
  int pieces;
  double length, off; // largest distance of a value from the level
  bool closed;
} trace;

static void add_piece(const plot_point *p, int count, void *user) {
  trace *t = user;
  t->pieces++;
  t->closed = p[0].x == p[count - 1].x && p[0].y == p[count - 1].y;
  for (int i = 0; i < count; i++) {
    if (i > 0) t->length += hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
    t->off = fmax(t->off, fabs(slope(p[i].x, p[i].y) - 1));
  }
}

static void contours_are_whole(void **state) {
  (void)state;
  field f;
  trace line = {0}, ellipse = {0};
  fill(&f, slope);
  assert_true(contour_trace(&f.grid, 1, add_piece, &line));
  assert_int_equal(line.pieces, 1);
  assert_near(line.length, hypot(1, 0.7), 1e-12);
  assert_below(line.off, 1e-14);
  fill(&f, bowl);
  assert_true(contour_trace(&f.grid, 0.8, add_piece, &ellipse));
  assert_int_equal(ellipse.pieces, 1);
  assert_true(ellipse.closed);
  assert_relative(ellipse.length, 3.8754, 0.01); // of half axes 0.8 and 0.4, after Ramanujan
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(regions_are_covered_once),
      cmocka_unit_test(holes_and_tears_are_left_out),
      cmocka_unit_test(contours_are_whole),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
