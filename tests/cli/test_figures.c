// SPDX-License-Identifier: Apache-2.0
// figures, effects, cycle and basin as a user runs them: files, tables, numbers, and what is wrong.
#include "run.h"
#include "support/near.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The roadster's limits, `bicycle stability roadster`.
static const double WEAVE = 4.947836005005, CAPSIZE = 6.985471303934;

static void run_well(const char *command) {
  run_result result = run_command(command);
  if (result.status != 0) fail_msg("%s: %s", command, result.err);
  run_free(&result);
}

static char *read_text(const char *name) {
  char path[512], *text = NULL;
  size_t size = 0;
  snprintf(path, sizeof path, "%s/%s", run_folder(), name);
  FILE *file = fopen(path, "r"), *copy = open_memstream(&text, &size);
  assert_non_null(file);
  for (int c = fgetc(file); c != EOF; c = fgetc(file)) fputc(c, copy);
  fclose(copy);
  fclose(file);
  return text;
}

// Called with each row of numbers of a table.
typedef void row_function(const double *row, void *user);
enum { COLUMNS = 4 };

static int each_row(const char *name, const char *header, row_function *function, void *user) {
  char *text = read_text(name), *at = strchr(text, '\n');
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

static int occurrences(const char *text, const char *word) {
  int count = 0;
  for (; (text = strstr(text, word)); text += strlen(word)) count++;
  return count;
}

// A picture is whole: closed, without numbers that are none, with at least so many curves.
static void check_picture(const char *name, int curves) {
  char *svg = read_text(name);
  assert_non_null(strstr(svg, "<title>"));
  assert_null(strstr(svg, "nan"));
  assert_null(strstr(svg, "inf"));
  assert_string_equal(svg + strlen(svg) - strlen("</svg>\n"), "</svg>\n");
  int found = occurrences(svg, "<path class=\"thin\"") +
              occurrences(svg, "<path class=\"dashed\"") + occurrences(svg, "<path class=\"heavy");
  if (found < curves) fail_msg("%s: %d curves", name, found);
  free(svg);
}

// Every label of a curve lies within the frame, and none on another.
static void check_labels(const char *name) {
  enum { ROOM = 256 };
  double x[ROOM], y[ROOM], half[ROOM];
  int count = 0;
  char *svg = read_text(name);
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
  char *page = read_text("out/index.html");
  assert_int_equal(occurrences(page, "<svg "), 6);
  assert_int_equal(occurrences(page, "</svg>"), 6);
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

static void cycles_are_listed(void **state) {
  (void)state;
  json_t *document = run_json("bicycle cycle roadster --leans 1deg:3deg:3 --json");
  assert_near(run_number(document, "weave_speed"), WEAVE, 1e-11);
  assert_true(json_is_true(json_object_get(json_object_get(document, "hopf"), "supercritical")));
  const json_t *cycles = json_object_get(document, "cycles");
  assert_int_equal(json_array_size(cycles), 3);
  double before = 0;
  for (size_t i = 0; i < 3; i++) {
    const json_t *cycle = json_array_get(cycles, i);
    assert_true(run_number(cycle, "distance") < before);
    assert_true(json_is_true(json_object_get(cycle, "stable")));
    before = run_number(cycle, "distance");
  }
  json_decref(document);
  // no weave speed is an answer
  run_result result = run_command("bicycle cycle roadster --search 8:20");
  assert_int_equal(result.status, 0);
  assert_non_null(strstr(result.out, "no cycle"));
  run_free(&result);
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
  char *table = read_text("basin.csv");
  assert_int_equal(occurrences(table, "\n"), 26);
  free(table);
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
      {"bicycle figures roadster -o file --speeds 5:6:3", "file"},
      {"bicycle figures roadster -o nosuch/out --speeds 5:6:3", "nosuch/out"},
      {"bicycle effects", "FILE is missing"},
      {"bicycle effects roadster --search 9:3", "--search"},
      {"bicycle effects roadster --speed x", "--speed"},
      {"bicycle effects roadster > /dev/full", "No space left"},
      {"bicycle cycle roadster --leans 0:10deg:3", "--leans"},
      {"bicycle cycle roadster --leans 10deg:100deg:3", "--leans"},
      {"bicycle cycle roadster --search 4", "--search"},
      {"bicycle basin roadster", "--speed is missing"},
      {"bicycle basin roadster --speed 0", "--speed"},
      {"bicycle basin roadster --speed 5 --leans 0:1deg:1", "--leans"},
      {"bicycle basin roadster --speed 5 --steers 9deg:1deg:5", "--steers"},
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
      cmocka_unit_test(cycles_are_listed),
      cmocka_unit_test(basin_draws_and_counts),
      cmocka_unit_test(wrong_command_lines),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
