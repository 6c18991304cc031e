// SPDX-License-Identifier: Apache-2.0
// What a reader of figures 2 to 4 must be able to tell apart: minus signs from dashes, neighbouring
// contours from each other; and the list of what was drawn.
#include "run.h"
#include "support/near.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Pixels, as the style sheet and plot_frame.h have them.
static const double DASH = 7, SPACE = 4, FONT = 13;
static const double LEFT = 84, TOP = 18, WIDTH = 560, HEIGHT = 400;

enum { MOST_LINES = 400, MOST_LABELS = 200 };

// A drawn line: from where to where, and how long.
typedef struct line {
  bool dashed;
  double ends[2][2], length;
} line;

typedef struct label {
  double x, y, angle, half_width; // angle in degrees
  bool negative;
} label;

typedef struct picture {
  char *svg;
  int line_count, label_count;
  line lines[MOST_LINES];
  label labels[MOST_LABELS];
} picture;

// The points of a path's data, "M1 2L3 4...": called with each in turn.
typedef void point_function(const double at[2], void *user);

static void each_point(const char *data, point_function *function, void *user) {
  double at[2];
  int used;
  while (sscanf(data, "%*1[ML]%lf %lf%n", &at[0], &at[1], &used) == 2) {
    function(at, user);
    data += used;
  }
}

static void extend(const double at[2], void *user) {
  line *l = user;
  if (isnan(l->ends[0][0]))
    memcpy(l->ends[0], at, sizeof l->ends[0]);
  else
    l->length += hypot(at[0] - l->ends[1][0], at[1] - l->ends[1][1]);
  memcpy(l->ends[1], at, sizeof l->ends[1]);
}

// Calls the function with the data of every contour.
typedef void path_function(const char *data, bool dashed, void *user);

static void each_path(const char *svg, path_function *function, void *user) {
  static const char *const classes[] = {"thin", "dashed", "heavy"};
  for (const char *at = svg; (at = strstr(at, "<path class=\"")); at++) {
    const char *name = at + strlen("<path class=\""), *data = strstr(at, " d=\"");
    for (int k = 0; k < 3; k++)
      if (strncmp(name, classes[k], strlen(classes[k])) == 0 && name[strlen(classes[k])] == '"')
        function(data + strlen(" d=\""), k == 1, user);
  }
}

static void take_line(const char *data, bool dashed, void *user) {
  picture *p = user;
  assert_true(p->line_count < MOST_LINES);
  line *l = &p->lines[p->line_count++];
  *l = (line){.dashed = dashed, .ends = {{NAN, NAN}, {NAN, NAN}}};
  each_point(data, extend, l);
}

static void take_labels(picture *p) {
  const char *at = p->svg;
  while ((at = strstr(at, "<text class=\"on\" text-anchor"))) {
    label *l = &p->labels[p->label_count++];
    assert_true(p->label_count < MOST_LABELS);
    at = strstr(at, "translate(");
    assert_int_equal(sscanf(at, "translate(%lf %lf) rotate(%lf)", &l->x, &l->y, &l->angle), 3);
    const char *text = strchr(at, '>') + 1, *end = strchr(text, '<');
    l->negative = strncmp(text, "\u2212", strlen("\u2212")) == 0;
    assert_true(*text != '-'); // a hyphen is no minus sign
    int characters = 0;
    for (const char *c = text; c < end; c++) characters += ((unsigned char)*c & 0xC0) != 0x80;
    l->half_width = 0.5 * FONT * 0.6 * characters; // no wider than it is
  }
}

static picture *picture_open(const char *name) {
  picture *p = calloc(1, sizeof *p);
  assert_non_null(p);
  p->svg = run_read(name);
  each_path(p->svg, take_line, p);
  take_labels(p);
  return p;
}

static void picture_close(picture *p) {
  free(p->svg);
  free(p);
}

// How far the end of a line is from a label's middle along the label; infinite if it is off its
// axis, and so belongs to another line.
static double distance_along(const label *l, const double end[2]) {
  double c = cos(l->angle * M_PI / 180), s = sin(l->angle * M_PI / 180);
  double x = end[0] - l->x, y = end[1] - l->y;
  return fabs(c * y - s * x) < 6 ? c * x + s * y : INFINITY;
}

// The nearest end of a dashed line on one side of a label.
typedef struct neighbour {
  double distance; // INFINITY: none
  double cut;      // pixels of a dash that was cut short there
} neighbour;

static neighbour nearest(const picture *p, const label *l, double side) {
  neighbour found = {INFINITY, 0};
  for (int i = 0; i < p->line_count; i++) {
    for (int end = 0; end < 2; end++) {
      double along = side * distance_along(l, p->lines[i].ends[end]);
      if (!p->lines[i].dashed || !(along > 0) || !(along < found.distance)) continue;
      double rest = fmod(p->lines[i].length + SPACE, DASH + SPACE);
      // a line begins with a whole dash; at its end it may break off
      found = (neighbour){along, end == 1 ? fmin(rest, DASH + SPACE - rest) : 0};
    }
  }
  return found;
}

// A dashed line ends before a label and goes on after it, at twice the space of dashes at least,
// and with a whole dash. Returns whether the label stands in a line.
static bool check_minus(const picture *p, const label *l) {
  neighbour before = nearest(p, l, -1), after = nearest(p, l, 1);
  if (!(before.distance < 60 && after.distance < 60)) return false; // beside its line
  assert_true(before.distance - l->half_width >= 2 * SPACE);
  assert_true(after.distance - l->half_width >= 2 * SPACE);
  assert_below(fmax(before.cut, after.cut), 0.3);
  return true;
}

static void minus_signs_are_no_dashes(void **state) {
  (void)state;
  static const char *const names[] = {"recumbent/fig2a.svg", "recumbent/fig2b.svg"};
  run_well("bicycle figures recumbent -o recumbent");
  for (int i = 0; i < 2; i++) {
    picture *p = picture_open(names[i]);
    int in_line = 0;
    for (int k = 0; k < p->label_count; k++)
      in_line += p->labels[k].negative && check_minus(p, &p->labels[k]);
    assert_true(in_line >= 3);
    picture_close(p);
  }
}

// Whether a contour has this label; ticks do not count.
static bool has_label(const char *svg, const char *text) {
  for (const char *at = svg; (at = strstr(at, "<text class=\"on\" text-anchor")); at++) {
    const char *words = strchr(at, '>') + 1;
    if (strncmp(words, text, strlen(text)) == 0 && words[strlen(text)] == '<') return true;
  }
  return false;
}

// Where lines cross a height of the picture.
typedef struct crossings {
  double y, x[MOST_LINES], last[2];
  int count;
} crossings;

static void cross(const double at[2], void *user) {
  crossings *c = user;
  if ((c->last[1] < c->y) != (at[1] < c->y) && !isnan(c->last[0])) {
    double part = (c->y - c->last[1]) / (at[1] - c->last[1]);
    c->x[c->count++] = c->last[0] + part * (at[0] - c->last[0]);
  }
  memcpy(c->last, at, sizeof c->last);
}

static void cross_path(const char *data, bool dashed, void *user) {
  (void)dashed;
  crossings *c = user;
  c->last[0] = c->last[1] = NAN;
  each_point(data, cross, c);
}

static int by_size(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

// The recumbent's offset falls from 5 cm to -50 cm over some pixels at a lean of 40 degrees: of the
// levels between, those that print can tell apart are drawn.
static void crowded_contours_are_thinned(void **state) {
  (void)state;
  crossings c = {.y = TOP + HEIGHT * (1 - 40.0 / 45)};
  char *svg = run_read("recumbent/fig2b.svg");
  assert_non_null(strstr(svg, "only some are drawn"));
  assert_true(has_label(svg, "10")); // small and closed, with its label beside it
  each_path(svg, cross_path, &c);
  free(svg);
  qsort(c.x, (size_t)c.count, sizeof c.x[0], by_size);
  assert_true(c.count >= 8);
  // lines of 1.1 pixels; the picture is 560 wide
  for (int i = 1; i < c.count; i++)
    if (!(c.x[i] - c.x[i - 1] >= 2))
      fail_msg("lines at %.2f and %.2f of %g", c.x[i - 1] - LEFT, c.x[i] - LEFT, WIDTH);
}

// Roadster: nothing is crowded over most of its length, and nothing is left out.
static void other_contours_are_all_drawn(void **state) {
  (void)state;
  static const char *const levels[] = {"0.2",     "0.5",       "1",         "2",       "5",
                                       "10",      "\u22120.2", "\u22120.5", "\u22121", "\u22122",
                                       "\u22125", "\u221210",  "\u221220"};
  run_well("bicycle figures roadster -o roadster");
  char *svg = run_read("roadster/fig2b.svg");
  assert_null(strstr(svg, "only some are drawn"));
  for (size_t i = 0; i < sizeof levels / sizeof levels[0]; i++) {
    if (!has_label(svg, levels[i])) fail_msg("no label %s", levels[i]);
  }
  free(svg);
}

static void check_axis(const json_t *axis, const char *unit, double from, double to) {
  assert_string_equal(json_string_value(json_object_get(axis, "unit")), unit);
  assert_near(run_number(axis, "from"), from, 1e-12 * fabs(to));
  assert_near(run_number(axis, "to"), to, 1e-12 * fabs(to));
}

// --json: each figure with files that are there, its axes and what is held.
static void figures_are_listed(void **state) {
  (void)state;
  json_t *list = run_json("bicycle figures roadster -o list --speeds 2:10:21 --leans 0:30deg:11 "
                          "--inertia 0:0.4:11 --trail 0:0.14:11 --fastest-trail 9 --json");
  const json_t *figures = json_object_get(list, "figures");
  assert_int_equal(json_array_size(figures), 6);
  assert_true(json_is_null(json_object_get(list, "missing")));
  for (size_t i = 0; i < 6; i++) {
    const json_t *figure = json_array_get(figures, i);
    static const char *const files[] = {"picture", "table"};
    for (int k = 0; k < 2; k++)
      free(run_read(json_string_value(json_object_get(figure, files[k]))));
    assert_true(strlen(json_string_value(json_object_get(figure, "held"))) > 20);
  }
  check_axis(json_object_get(json_array_get(figures, 0), "x"), "m/s", 2, 10);
  check_axis(json_object_get(json_array_get(figures, 0), "y"), "deg", 0, 30);
  check_axis(json_object_get(json_array_get(figures, 4), "x"), "kg m\u00b2", 0, 0.4);
  check_axis(json_object_get(json_array_get(figures, 5), "x"), "cm", 0, 14);
  check_axis(json_object_get(json_array_get(figures, 5), "y"), "m/s", 0, 9);
  json_decref(list);
  json_t *riderless = run_json("bicycle figures benchmark -o listless --json");
  assert_int_equal(json_array_size(json_object_get(riderless, "figures")), 2);
  const char *missing = json_string_value(json_object_get(riderless, "missing"));
  assert_non_null(strstr(missing, "`rider: true` in a list of parts"));
  assert_non_null(strstr(missing, "`rider_share` in a file of Meijaard's symbols"));
  json_decref(riderless);
}

// Figure 3 of a bicycle with two stable ranges has both, at the bicycle as it is.
static void several_ranges_are_drawn(void **state) {
  (void)state;
  run_well("bicycle figures \"" BICYCLE_SOURCE_DIR
           "/tests/motion/several_ranges/long_trail.yml\" -o two --inertia 0:0.0236:3");
  char *csv = run_read("two/fig3.csv");
  static const double ranges[][2] = {{3.914618911659, 4.513015521177}, {6.358180733222, INFINITY}};
  int found = 0;
  double value, from, to;
  for (const char *row = strchr(csv, '\n'); row && row[1]; row = strchr(row + 1, '\n')) {
    if (sscanf(row, "\n0,%lf,%lf,%lf", &value, &from, &to) != 3) continue;
    if (fabs(value - 0.0118) > 1e-15) continue;
    assert_true(found < 2);
    assert_near(from, ranges[found][0], 1e-11);
    if (found == 0) assert_near(to, ranges[0][1], 1e-11);
    if (found == 1) assert_true(isinf(to));
    found++;
  }
  assert_int_equal(found, 2);
  free(csv);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(minus_signs_are_no_dashes),
      cmocka_unit_test(crowded_contours_are_thinned),
      cmocka_unit_test(other_contours_are_all_drawn),
      cmocka_unit_test(figures_are_listed),
      cmocka_unit_test(several_ranges_are_drawn),
  };
  return cmocka_run_group_tests(tests, run_enter_group, run_leave_group);
}
