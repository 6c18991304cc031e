// SPDX-License-Identifier: Apache-2.0
// What a sweep says of a point is what the other commands say of it; failures are told, and do not
// stop the others.
#include "sweeps.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FIELDS = 16 };

// A table of a sweep, its fields as text. Free `text`.
typedef struct table {
  char *text;
  int rows;
  char *field[256][MOST_FIELDS]; // row 0 is the header
} table;

static table read_table(const char *name) {
  table t = {.text = sweep_read(name)};
  char *rest = t.text;
  for (char *line; (line = strsep(&rest, "\n")) && *line; t.rows++) {
    assert_true(t.rows < 256);
    int i = 0;
    for (char *field; (field = strsep(&line, ",")) && i < MOST_FIELDS;)
      t.field[t.rows][i++] = field;
  }
  return t;
}

static const char *cell(const table *t, int row, const char *column) {
  for (int i = 0; i < MOST_FIELDS && t->field[0][i]; i++)
    if (strcmp(t->field[0][i], column) == 0) return t->field[row][i];
  fail_msg("no column '%s'", column);
  return "";
}

static double number(const table *t, int row, const char *column) {
  char *end;
  const char *text = cell(t, row, column);
  const double value = strtod(text, &end);
  if (end == text || *end) fail_msg("row %d: %s: '%s' is no number", row, column, text);
  return value;
}

static json_t *ask(const char *format, double value) {
  char command[256];
  snprintf(command, sizeof command, format, value);
  return run_json(command);
}

// Against `bicycle stability`, of the file edited by hand.
static void critical_speeds_of_an_edited_file(void **state) {
  (void)state;
  sweep_write("spec.yml",
              "bicycle: benchmark\nsweep:\n  c: [0.02, 0.08, 0.3]\n  speed: 5\noutputs: "
              "[weave_speed, capsize_speed, stable_ranges, eps_max]\n");
  sweep_run(0, "bicycle sweep spec.yml -o spec");
  table t = read_table("spec.csv");
  assert_int_equal(t.rows, 4);
  for (int row = 1; row < t.rows; row++) {
    sweep_run(0, "sed 's/  c: .*/  c: %s/' \"%s/model/benchmark/benchmark.yml\" > edited.yml",
              cell(&t, row, "c"), BICYCLE_SOURCE_DIR);
    json_t *asked = ask("bicycle stability ./edited.yml --speeds %g:5:1 --json", 5);
    static const char *const keys[] = {"weave_speed", "capsize_speed"};
    for (int i = 0; i < 2; i++) {
      if (json_is_null(json_object_get(asked, keys[i])))
        assert_string_equal(cell(&t, row, keys[i]), "");
      else
        assert_near(number(&t, row, keys[i]), run_number(asked, keys[i]), 0);
    }
    const json_t *at = json_array_get(json_object_get(asked, "eigenvalues"), 0);
    const json_t *first = json_array_get(json_object_get(at, "values"), 0);
    assert_near(number(&t, row, "eps_max"), json_number_value(json_array_get(first, 0)), 0);
    double low, high;
    const json_t *range = json_array_get(json_object_get(asked, "stable_ranges"), 0);
    if (range) {
      assert_int_equal(sscanf(cell(&t, row, "stable_ranges"), "%lf:%lf", &low, &high), 2);
      assert_near(low, json_number_value(json_array_get(range, 0)), 0);
      assert_near(high, json_number_value(json_array_get(range, 1)), 0);
    }
    json_decref(asked);
  }
  free(t.text);
}

// Against `bicycle basin`: the same starts, the same fates.
static void outcomes_of_the_basin(void **state) {
  (void)state;
  sweep_write("basin.yml", "bicycle: roadster\nsweep:\n  speed: 5.8\n"
                           "  steer: {from: -1, to: 1, count: 5}\n"
                           "  lean: {from: -0.8, to: 0.8, count: 9}\n"
                           "outputs: [outcome]\nride: {start_speed: same_energy}\n");
  sweep_run(0, "bicycle sweep basin.yml -o basin");
  json_t *asked =
      run_json("bicycle basin roadster --speed 5.8 --leans -0.8:0.8:9 --steers -1:1:5 --json");
  const json_t *fates = json_object_get(asked, "fates");
  static const char *const words[][2] = {{"straight", "recovers"},
                                         {"lifted", "lifts"},
                                         {"riding", "undecided"},
                                         {"fallen", "falls"},
                                         {"no start", ""}};
  table t = read_table("basin.csv");
  int seen = 0;
  assert_int_equal(t.rows, 1 + (int)json_array_size(fates));
  for (int row = 1; row < t.rows; row++) {
    const json_t *fate = json_array_get(fates, (size_t)row - 1);
    assert_near(number(&t, row, "lean"), json_number_value(json_array_get(fate, 0)), 1e-15);
    assert_near(number(&t, row, "steer"), json_number_value(json_array_get(fate, 1)), 1e-15);
    for (int i = 0; i < 5; i++) {
      if (strcmp(words[i][0], json_string_value(json_array_get(fate, 2))) != 0) continue;
      assert_string_equal(cell(&t, row, "outcome"), words[i][1]);
      assert_int_equal(*cell(&t, row, "error") != '\0', i == 4);
      seen |= 1 << i;
    }
  }
  assert_true(seen & 1 && seen & 8); // some come back, some fall
  json_decref(asked);
  free(t.text);
}

// Against `bicycle turn`: the first of the main family.
static void turns(void **state) {
  (void)state;
  sweep_write("turn.yml",
              "bicycle: roadster\nsweep:\n  speed: 5.5\n  lean: [0, 0.1, 0.3]\noutputs: "
              "[turn_eps_max, eps_max]\n");
  sweep_run(0, "bicycle sweep turn.yml -o turn");
  table t = read_table("turn.csv");
  assert_string_equal(cell(&t, 1, "turn_eps_max"), cell(&t, 1, "eps_max"));
  for (int row = 2; row < t.rows; row++) {
    json_t *asked =
        ask("bicycle turn roadster --speed 5.5 --lean %.17g --json", number(&t, row, "lean"));
    const json_t *first = json_array_get(json_object_get(asked, "solutions"), 0);
    assert_near(number(&t, row, "turn_eps_max"), run_number(first, "eps_max"), 1e-12);
    json_decref(asked);
  }
  free(t.text);
}

// Properties are those of `bicycle effects` and the figures: the front held as asked.
static void properties(void **state) {
  (void)state;
  static const char spec[] = "bicycle: roadster\nsweep: {property.trail: [0.07, 0.1], speed: 5.5}\n"
                             "outputs: [weave_speed, eps_max]\nfront: %s\n";
  char text[512];
  snprintf(text, sizeof text, spec, "in_space");
  sweep_write("space.yml", text);
  snprintf(text, sizeof text, spec, "on_axis");
  sweep_write("axis.yml", text);
  sweep_write("file.yml", "bicycle: roadster\nsweep: {geometry.trail: [0.07, 0.1], speed: 5.5}\n"
                          "outputs: [weave_speed, eps_max]\n");
  sweep_run(0, "for s in space axis file; do bicycle sweep $s.yml -o $s || exit 1; done");
  table space = read_table("space.csv"), axis = read_table("axis.csv"),
        file = read_table("file.csv");
  for (int row = 1; row <= 2; row++) // the file's positions are places in space
    assert_near(number(&space, row, "weave_speed"), number(&file, row, "weave_speed"), 1e-9);
  assert_near(number(&axis, 1, "weave_speed"), number(&file, 1, "weave_speed"), 1e-9);
  assert_true(fabs(number(&axis, 2, "weave_speed") - number(&file, 2, "weave_speed")) > 1e-3);
  free(space.text);
  free(axis.text);
  free(file.text);
}

// Uncertainties of the file as the law of a draw.
static void uncertainty_of_the_file(void **state) {
  (void)state;
  sweep_run(0,
            "sed -n '/^values:/,$p' \"%s/model/benchmark/benchmark.yml\" | sed -e 1d -e "
            "'s/ *#.*//' -e '/v:/d' -e 's/^ *//' -e 's/: / = /' -e 's/^mB.*/mB = 85+-2/' -e "
            "'s/+-/+\\/-/' > measured.txt",
            BICYCLE_SOURCE_DIR);
  sweep_write("draw.yml",
              "bicycle: measured.txt\nseed: 4\ndraws: 100\nsweep: {mB: {normal: file}}\n"
              "outputs: [weave_speed]\n");
  sweep_run(0, "bicycle sweep draw.yml -o draw");
  table t = read_table("draw.csv");
  double sum = 0, squares = 0;
  for (int row = 1; row < t.rows; row++) {
    sum += (number(&t, row, "mB") - 85) / 100;
    squares += pow(number(&t, row, "mB") - 85, 2) / 100;
  }
  assert_near(sum, 0, 5 * 2.0 / 10);                // five standard errors
  assert_near(sqrt(squares), 2, 5 * 2 / sqrt(200)); //
  free(t.text);
}

static void failures_are_told(void **state) {
  (void)state;
  sweep_write("some.yml", "bicycle: roadster\nsweep: {parts.rider.mass: [-5, 0, 70]}\n"
                          "outputs: [weave_speed]\n");
  run_result result = run_command("bicycle sweep some.yml -o some --json");
  assert_int_equal(result.status, 0);
  assert_non_null(strstr(result.err, "2 of 3 points lack outputs"));
  assert_non_null(strstr(result.out, "\"failed\": 2"));
  run_free(&result);
  table t = read_table("some.csv");
  assert_string_equal(cell(&t, 1, "error"), "part 'rider': mass must be positive");
  assert_string_equal(cell(&t, 1, "weave_speed"), "");
  assert_string_equal(cell(&t, 3, "error"), "");
  assert_true(number(&t, 3, "weave_speed") > 0);
  free(t.text);
  // every one of them: 3, also when nothing is left to do
  sweep_write("all.yml", "bicycle: roadster\nsweep: {parts.rider.mass: [-5, 0]}\n"
                         "outputs: [weave_speed]\n");
  sweep_run(3, "bicycle sweep all.yml -o all");
  sweep_run(3, "bicycle sweep all.yml -o all");
  char *csv = sweep_read("all.csv");
  free(csv);
}

#define NOT_STRAIGHT                                                                               \
  "the state asked for is not a stationary motion (riding straight is one only of a bicycle that " \
  "is its own mirror image)"
#define NO_GEOMETRY "no geometry: both wheels cannot touch the ground at this lean and steer"

// A rider who sits beside cannot ride straight, and 1.57 rad is no start: each output for itself.
static void a_point_keeps_what_succeeded(void **state) {
  (void)state;
  static const char *const columns[] = {"weave_speed", "outcome", "eps_max", "time",
                                        "capsize_speed"};
  static const struct {
    const char *succeeded; // of the columns
    const char *error;
  } rows[] = {
      {"yyyyy", ""},
      {"ynyny", "outcome time: " NO_GEOMETRY},
      {"nynyn", "weave_speed eps_max capsize_speed: " NOT_STRAIGHT},
      {"nnnnn", "weave_speed eps_max capsize_speed: " NOT_STRAIGHT "; outcome time: " NO_GEOMETRY},
  };
  sweep_write("part.yml", "bicycle: roadster\nsweep: {parts.rider.position.left: [0, 0.01], "
                          "speed: 5, lean: [0.1, 1.57], steer: 1.3}\n"
                          "outputs: [weave_speed, outcome, eps_max, time, capsize_speed]\n");
  for (int again = 0; again < 2; again++) { // the second counts what stands in the log
    json_t *report = run_json("bicycle sweep part.yml -o part --json");
    assert_near(run_number(report, "failed"), 3, 0);
    assert_near(run_number(report, "resumed"), again ? 4 : 0, 0);
    json_decref(report);
  }
  assert_int_equal(sweep_merged_count("part.log", "failed"), 3);
  table t = read_table("part.csv");
  for (int row = 0; row < 4; row++) {
    for (int i = 0; i < 5; i++)
      assert_int_equal(*cell(&t, row + 1, columns[i]) != '\0', rows[row].succeeded[i] == 'y');
    assert_string_equal(cell(&t, row + 1, "error"), rows[row].error);
  }
  // none has all its outputs: 3
  sweep_run(3, "sed 's/left: .0, /left: [/' part.yml > none.yml; bicycle sweep none.yml -o none");
  // what one output says does not depend on the others
  sweep_run(0, "sed 's/^outputs: .*/outputs: [time, outcome]/' part.yml > two.yml; "
               "bicycle sweep two.yml -o two");
  table two = read_table("two.csv");
  for (int row = 1; row <= 4; row++) {
    assert_string_equal(cell(&t, row, "outcome"), cell(&two, row, "outcome"));
    assert_string_equal(cell(&t, row, "time"), cell(&two, row, "time"));
  }
  assert_string_equal(cell(&two, 4, "error"), "time outcome: " NO_GEOMETRY);
  free(two.text);
  free(t.text);
}

static void examples_run(void **state) {
  (void)state;
  sweep_run(0,
            "for e in \"%s\"/src/sweep/examples/*.yml; do bicycle sweep $e -o example --fresh || "
            "exit 1; done",
            BICYCLE_SOURCE_DIR);
}

static void names_are_listed(void **state) {
  (void)state;
  json_t *names = run_json("bicycle sweep names roadster --json");
  assert_near(run_number(names, "geometry.trail"), 0.07, 0);
  assert_near(run_number(names, "parts.rider.position.up"), 1.08, 0);
  json_decref(names);
  sweep_run(0, "bicycle sweep names benchmark | grep -q '^IByy  *11$'");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(critical_speeds_of_an_edited_file),
      cmocka_unit_test(outcomes_of_the_basin),
      cmocka_unit_test(turns),
      cmocka_unit_test(properties),
      cmocka_unit_test(uncertainty_of_the_file),
      cmocka_unit_test(failures_are_told),
      cmocka_unit_test(a_point_keeps_what_succeeded),
      cmocka_unit_test(examples_run),
      cmocka_unit_test(names_are_listed),
  };
  return cmocka_run_group_tests(tests, run_enter_group, run_leave_group);
}
