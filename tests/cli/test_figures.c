// SPDX-License-Identifier: Apache-2.0
// figures, effects and basin as a user runs them: files, tables, numbers, and what is wrong.
#include "run.h"
#include "support/near.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The roadster's limits, `bicycle stability roadster`.
static const double WEAVE = 4.947836005005, CAPSIZE = 6.985471303934;

// Called with each row of numbers of a table.
typedef void row_function(const double *row, void *user);
enum { COLUMNS = 4 };

static int each_row(const char *name, const char *header, row_function *function, void *user) {
  char *text = run_read(name), *at = strchr(text, '\n');
  int rows = 0;
  assert_non_null(at);
  assert_int_equal(strncmp(text, header, strlen(header)), 0);
  for (at++; *at; at++, rows++) {
    double row[COLUMNS] = {0};
    for (int i = 0; i < COLUMNS; i++) {
      char *end;
      row[i] = strtod(at, &end);
      assert_true(end > at);
      at = end;
      if (*at == '\n') break;
      assert_int_equal(*at++, ',');
    }
    function(row, user);
  }
  free(text);
  return rows;
}

// A picture is whole: closed, without numbers that are none, with at least so many curves.
static void check_picture(const char *name, int curves) {
  char *svg = run_read(name);
  assert_non_null(strstr(svg, "<title>"));
  assert_null(strstr(svg, "nan"));
  assert_null(strstr(svg, "inf"));
  assert_string_equal(svg + strlen(svg) - strlen("</svg>\n"), "</svg>\n");
  int found = run_occurrences(svg, "<path class=\"thin\"") +
              run_occurrences(svg, "<path class=\"dashed\"") +
              run_occurrences(svg, "<path class=\"heavy");
  if (found < curves) fail_msg("%s: %d curves", name, found);
  free(svg);
}

// Every label of a curve lies within the frame, and none on another.
static void check_labels(const char *name) {
  enum { ROOM = 256 };
  double x[ROOM], y[ROOM], half[ROOM];
  int count = 0;
  char *svg = run_read(name);
  const char *at = svg;
  while ((at = strstr(at, "<text class=\"on\" text-anchor")) && count < ROOM) {
    at = strstr(at, "translate(");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "translate(%lf %lf)", &x[count], &y[count]), 2);
    const char *text = strchr(at, '>') + 1;
    half[count] = 0.3 * 13 * (double)(strchr(text, '<') - text) * 0.5; // of the font's 13 pixels
    assert_true(x[count] > 84 && x[count] < 84 + 560 && y[count] > 18 && y[count] < 18 + 400);
    count++;
  }
  assert_true(count >= 6);
  for (int a = 0; a < count; a++)
    for (int b = 0; b < a; b++)
      if (hypot(x[a] - x[b], y[a] - y[b]) < fmax(half[a] + half[b], 8))
        fail_msg("%s: labels at %g, %g overlap", name, x[a], y[a]);
  free(svg);
}

static void figures_are_whole(void **state) {
  (void)state;
  run_well("bicycle figures roadster -o out --speeds 2:10:81 --leans 0:45deg:61");
  check_picture("out/fig2a.svg", 6);
  check_picture("out/fig2b.svg", 12);
  check_picture("out/fig2c.svg", 8);
  check_picture("out/fig2d.svg", 5);
  check_picture("out/fig3.svg", 4);
  check_picture("out/fig4.svg", 4);
  check_labels("out/fig2a.svg");
  check_labels("out/fig2b.svg");
  check_labels("out/fig2c.svg");
  char *page = run_read("out/index.html");
  assert_int_equal(run_occurrences(page, "<svg "), 6);
  assert_int_equal(run_occurrences(page, "</svg>"), 6);
  free(page);
  run_result result = run_command("ls out | wc -l");
  assert_int_equal(atoi(result.out), 13); // nothing is left of writing
  run_free(&result);
}

// The row of figure 2 nearest to a speed and lean, and the extent of the stable region.
typedef struct map_check {
  double speed, lean, value, distance;
  double slowest, fastest;
} map_check;

static void check_map_row(const double *row, void *user) {
  map_check *c = user;
  double distance = fabs(row[0] - c->speed) + fabs(row[1] - c->lean);
  if (distance < c->distance) {
    c->distance = distance;
    c->value = row[2];
  }
  if (row[1] == 0 && row[2] < 0) {
    c->slowest = fmin(c->slowest, row[0]);
    c->fastest = fmax(c->fastest, row[0]);
  }
}

static map_check check_map(const char *name, const char *header, double speed, double lean) {
  map_check c = {speed, lean, NAN, INFINITY, INFINITY, -INFINITY};
  int rows = each_row(name, header, check_map_row, &c);
  assert_int_equal(rows, 81 * 46);
  assert_below(c.distance, 1e-9);
  return c;
}

static double turn_number(const char *key) {
  json_t *document = run_json("bicycle turn roadster --speed 6 --lean 10deg --json");
  const json_t *turn = json_array_get(json_object_get(document, "solutions"), 0);
  double value = run_number(turn, key);
  json_decref(document);
  return value;
}

static void figure_2_shows_stationary_motion(void **state) {
  (void)state;
  const double lean = 10 * M_PI / 180;
  run_well("bicycle figures roadster -o two --speeds 2:10:81 --leans 0:45deg:46");
  map_check steer = check_map("two/fig2a.csv", "speed,lean,steer\n", 6, lean);
  map_check offset = check_map("two/fig2b.csv", "speed,lean,rider_offset\n", 6, lean);
  map_check eps = check_map("two/fig2c.csv", "speed,lean,eps_max\n", 6, lean);
  map_check time = check_map("two/fig2d.csv", "speed,lean,reaction_time\n", 9, 0.5 * M_PI / 2);
  assert_near(steer.value, turn_number("steer"), 1e-10);
  assert_near(offset.value, turn_number("rider_offset"), 1e-10);
  assert_near(eps.value, turn_number("eps_max"), 1e-7);
  assert_true(time.value > 0 && time.value < 20);
  // upright: stable between the limits, to the step of the grid
  assert_true(eps.slowest > WEAVE && eps.slowest < WEAVE + 0.1);
  assert_true(eps.fastest < CAPSIZE && eps.fastest > CAPSIZE - 0.1);
  // sae turns the steer and nothing else
  run_well("bicycle figures roadster -o sae --speeds 2:10:81 --leans 0:45deg:46 "
           "--convention sae");
  map_check right = check_map("sae/fig2a.csv", "speed,lean,steer\n", 6, lean);
  map_check same = check_map("sae/fig2b.csv", "speed,lean,rider_offset\n", 6, lean);
  assert_near(right.value, -steer.value, 0);
  assert_near(same.value, offset.value, 0);
}

typedef struct range_check {
  double family, value, from, to;
  double lowest_value; // of the family
} range_check;

static void check_range_row(const double *row, void *user) {
  range_check *c = user;
  if (row[0] != c->family) return;
  c->lowest_value = fmin(c->lowest_value, row[1]);
  if (fabs(row[1] - c->value) > 1e-12) return;
  c->from = row[2];
  c->to = row[3];
}

static range_check check_ranges(const char *name, const char *header, int family, double value) {
  range_check c = {family, value, NAN, NAN, INFINITY};
  assert_true(each_row(name, header, check_range_row, &c) > 100);
  return c;
}

static void figures_3_and_4_pass_through_the_bicycle(void **state) {
  (void)state;
  run_well("bicycle figures roadster -o three --speeds 5:6:3 --leans 0:1deg:3 "
           "--inertia 0:0.4:101 --trail 0:0.14:101");
  for (int family = 0; family < 2; family++) {
    range_check inertia =
        check_ranges("three/fig3.csv",
                     "rear_wheel_kept,front_wheel_inertia,stable_from,stable_to\n", family, 0.2);
    range_check trail =
        check_ranges("three/fig4.csv", "front_on_axis,trail,stable_from,stable_to\n", family, 0.07);
    assert_near(inertia.from, WEAVE, 1e-11);
    assert_near(inertia.to, CAPSIZE, 1e-11);
    assert_near(trail.from, WEAVE, 1e-10);
    assert_near(trail.to, CAPSIZE, 1e-10);
  }
  // with the rear wheel kept the lower limit stays finite down to no inertia at all
  range_check kept = check_ranges(
      "three/fig3.csv", "rear_wheel_kept,front_wheel_inertia,stable_from,stable_to\n", 1, 0);
  assert_near(kept.from, 12.84, 0.005);
  assert_true(isinf(kept.to));
}

static void a_bicycle_without_rider_has_two_figures(void **state) {
  (void)state;
  run_result result = run_command("bicycle figures benchmark -o three_four; ls three_four");
  assert_non_null(strstr(result.err, "Figure 2 is missing"));
  assert_string_equal(result.out, "fig3.csv\nfig3.svg\nfig4.csv\nfig4.svg\nindex.html\n");
  run_free(&result);
}

static void effects_tell_what_is_held(void **state) {
  (void)state;
  json_t *document = run_json("bicycle effects roadster --json");
  assert_near(run_number(document, "weave_speed"), WEAVE, 1e-11);
  assert_near(run_number(document, "capsize_speed"), CAPSIZE, 1e-11);
  assert_true(json_is_null(json_object_get(document, "weave_uncertainty")));
  const json_t *effects = json_object_get(document, "effects");
  assert_true(json_array_size(effects) >= 9);
  int trails = 0;
  for (size_t i = 0; i < json_array_size(effects); i++) {
    const json_t *effect = json_array_get(effects, i);
    const char *name = json_string_value(json_object_get(effect, "parameter"));
    assert_true(strlen(json_string_value(json_object_get(effect, "held"))) > 5);
    if (strcmp(name, "trail") != 0) continue;
    trails++;
    double change = run_number(effect, "to") - run_number(effect, "from");
    // a centimetre: the slope tells the change to a tenth
    assert_near(run_number(effect, "capsize_speed") - CAPSIZE,
                change * run_number(effect, "capsize_slope"), 0.05);
  }
  assert_int_equal(trails, 2); // both ways
  json_decref(document);
}

static void effects_carry_uncertainty(void **state) {
  (void)state;
  // the benchmark's symbols as a text file, the trail with an uncertainty of a millimetre
  run_well("awk '/^ +[A-Za-z]+: [-0-9.e]+/ && !/g:/ {sub(\":\",\"\",$1);"
           "print $1 \" = \" $2 ($1 == \"c\" ? \"+/-0.001\" : \"\")} /^ +g:/ {print \"g = \" $2}' "
           "\"" BICYCLE_SOURCE_DIR "/model/benchmark/benchmark.yml\" > b.txt");
  json_t *document = run_json("bicycle effects b.txt --json");
  const json_t *parameters = json_object_get(document, "parameters");
  double slope = NAN;
  for (size_t i = 0; i < json_array_size(parameters); i++) {
    const json_t *p = json_array_get(parameters, i);
    if (strcmp(json_string_value(json_object_get(p, "parameter")), "c") == 0)
      slope = run_number(p, "weave_slope");
  }
  assert_near(run_number(document, "weave_uncertainty"), 0.001 * slope, 1e-12);
  assert_true(slope > 1);
  json_decref(document);
}

// The benchmark 1024 times smaller, of the same masses: speeds are 32 times lower, and so are those
// after changes as much smaller. (Trails change by a centimetre, the damping by one N m s.)
static void effects_follow_the_size(void **state) {
  (void)state;
  run_well("awk '/^ +[A-Za-z]+: [-0-9.e]+/ {sub(\":\",\"\",$1); f = 1;"
           "if ($1 ~ /^(w|c|r[RF]|[xz][BH])$/) f = 1024; if ($1 ~ /^I/) f = 1024*1024;"
           "printf \"%s = %.17g\\n\", $1, $2/f}' "
           "\"" BICYCLE_SOURCE_DIR "/model/benchmark/benchmark.yml\" > small.txt");
  json_t *usual = run_json("bicycle effects benchmark --json");
  json_t *small = run_json("bicycle effects small.txt --json");
  const double slower = 1.0 / 32;
  assert_near(run_number(small, "weave_speed"), slower * run_number(usual, "weave_speed"), 1e-10);
  const json_t *are = json_object_get(small, "effects");
  const json_t *should = json_object_get(usual, "effects");
  assert_int_equal(json_array_size(are), json_array_size(should));
  int compared = 0;
  for (size_t i = 0; i < json_array_size(should); i++) {
    const json_t *a = json_array_get(are, i), *b = json_array_get(should, i);
    if (!json_is_number(json_object_get(b, "weave_speed"))) continue;
    assert_near(run_number(a, "weave_speed"), slower * run_number(b, "weave_speed"), 1e-10);
    compared++;
  }
  assert_true(compared >= 6);
  json_decref(usual);
  json_decref(small);
}

static void basin_draws_and_counts(void **state) {
  (void)state;
  json_t *document = run_json("bicycle basin roadster --speed 5.8 --leans -30deg:30deg:5 "
                              "--steers -30deg:30deg:5 -o basin.svg --json");
  assert_true(json_is_true(json_object_get(document, "straight_is_stable")));
  assert_int_equal(json_array_size(json_object_get(document, "fates")), 25);
  const json_t *middle = json_array_get(json_object_get(document, "fates"), 12);
  assert_string_equal(json_string_value(json_array_get(middle, 2)), "straight");
  json_decref(document);
  check_picture("basin.svg", 0);
  char *table = run_read("basin.csv");
  assert_int_equal(run_occurrences(table, "\n"), 26);
  free(table);
}

// A bicycle that is stable nowhere is drawn and described like any other.
static void no_stable_range_is_an_answer(void **state) {
  (void)state;
  static const char *const commands[] = {
      "bicycle figures roadster_riderless -o nowhere",
      "bicycle effects roadster_riderless --json",
      "bicycle effects roadster --search 0:3",
      "bicycle stability roadster_riderless --search 0:1000",
      "bicycle cycle roadster_riderless --leans 1deg:2deg:2",
      "bicycle basin roadster --speed 3 --leans 0:10deg:2 --steers 0:10deg:2",
  };
  for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) run_well(commands[i]);
  // no range is no reason for a picture without curves, and none of a wrong one
  char *svg = run_read("nowhere/fig4.svg");
  assert_non_null(strstr(svg, "Never stable:"));
  free(svg);
  run_result basin =
      run_command("bicycle basin roadster --speed 3 --leans 0:10deg:2 --steers 0:10deg:2");
  assert_non_null(strstr(basin.err, "riding straight at 3 m/s is not stable"));
  run_free(&basin);
}

static void wrong_command_lines(void **state) {
  (void)state;
  static const run_wrong commands[] = {
      {"bicycle figures roadster", "-o DIR"},
      {"bicycle figures -o out2", "FILE is missing"},
      {"bicycle figures nosuch -o out2", "nosuch"},
      {"bicycle figures roadster -o out2 --speeds 10:2:5", "--speeds"},
      {"bicycle figures roadster -o out2 --speeds 2:10:2", "--speeds"},
      {"bicycle figures roadster -o out2 --speeds -1:10:20", "--speeds"},
      {"bicycle figures roadster -o out2 --leans 0:95deg:20", "--leans"},
      {"bicycle figures roadster -o out2 --leans 45deg:0:20", "--leans"},
      {"bicycle figures roadster -o out2 --inertia 0.2:0.1:20", "--inertia"},
      {"bicycle figures roadster -o out2 --trail 0:0.1", "--trail"},
      {"bicycle figures roadster -o out2 --fastest-trail 0", "--fastest-trail"},
      {"bicycle figures roadster -o out2 --fastest-trail 1e300", "--fastest-trail: 1e300 m/s"},
      {"bicycle figures roadster -o out2 --fastest-inertia 1e-300", "--fastest-inertia: 1e-300"},
      {"bicycle figures roadster -o out2 --speeds 0:1e308:5", "--speeds: 1e+308 m/s"},
      {"bicycle figures roadster -o out2 --speeds 5:5:5", "--speeds"},
      {"bicycle figures roadster -o out2 --inertia 0:0:5", "--inertia"},
      {"bicycle figures roadster -o out2 --trail 0:nan:5", "--trail"},
      {"bicycle figures roadster -o out2 --leans 3deg:3deg:5", "--leans"},
      {"bicycle figures roadster -o ''", "-o DIR"},
      {"bicycle figures roadster -o out2 --convention din", "--convention"},
      {"bicycle figures roadster -o file --speeds 5:6:3", "file"},
      {"bicycle figures roadster -o nosuch/out --speeds 5:6:3", "nosuch/out"},
      {"bicycle effects", "FILE is missing"},
      {"bicycle effects roadster --search 9:3", "--search"},
      {"bicycle effects roadster --search 3:3", "--search"},
      {"bicycle effects roadster --speed x", "--speed"},
      {"bicycle effects roadster > /dev/full", "No space left"},
      {"bicycle basin roadster", "--speed is missing"},
      {"bicycle basin roadster --speed 0", "--speed"},
      {"bicycle basin roadster --speed 5 --leans 0:1deg:1", "--leans"},
      {"bicycle basin roadster --speed 5 --steers 9deg:1deg:5", "--steers"},
      {"bicycle basin roadster --speed 5 --leans 9deg:9deg:5", "--leans"},
      {"bicycle basin roadster --speed -5", "--speed"},
      {"bicycle basin roadster --speed 1e300 --leans 0:1deg:2 --steers 0:1deg:2", "too large"},
      {"bicycle basin roadster --speed 5 --time 1", "--time"},
      {"bicycle basin roadster --speed 5 --threads 0", "--threads"},
      {"bicycle basin roadster --speed 5 -o basin.png", "-o"},
      {"bicycle basin roadster --speed 5 --leans 0:1deg:2 --steers 0:1deg:2 -o nosuch/x.svg",
       "nosuch/x.svg"},
  };
  run_all_wrong(commands, sizeof commands / sizeof commands[0]);
}

static int enter(void **state) {
  (void)state;
  return run_enter_filled(": > file");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(figures_are_whole),
      cmocka_unit_test(figure_2_shows_stationary_motion),
      cmocka_unit_test(figures_3_and_4_pass_through_the_bicycle),
      cmocka_unit_test(a_bicycle_without_rider_has_two_figures),
      cmocka_unit_test(effects_tell_what_is_held),
      cmocka_unit_test(effects_carry_uncertainty),
      cmocka_unit_test(effects_follow_the_size),
      cmocka_unit_test(basin_draws_and_counts),
      cmocka_unit_test(no_stable_range_is_an_answer),
      cmocka_unit_test(wrong_command_lines),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
