// SPDX-License-Identifier: Apache-2.0
// `bicycle cycle` as a user runs it: the branch, the cycles of one speed, the picture.
#include "run.h"
#include "support/near.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The roadster's, `bicycle stability roadster`.
static const double WEAVE = 4.947836005005;

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

static const json_t *at_speed(const json_t *document) {
  return json_object_get(json_object_get(document, "at_speed"), "cycles");
}

// The cycle of a speed lies on the branch, and there is none on the other side.
static void cycles_of_one_speed(void **state) {
  (void)state;
  json_t *document = run_json("bicycle cycle roadster --speed 4.9 --json");
  assert_int_equal(json_array_size(at_speed(document)), 1);
  const json_t *cycle = json_array_get(at_speed(document), 0);
  double lean = run_number(cycle, "lean");
  assert_near(run_number(cycle, "speed"), 4.9, 1e-9);
  const json_t *cycles = json_object_get(document, "cycles");
  assert_true(lean > run_number(json_array_get(cycles, 2), "lean"));
  assert_true(lean < run_number(json_array_get(cycles, 3), "lean"));
  assert_below(run_number(cycle, "residual"), 1e-9);
  json_decref(document);
  // asked for by its amplitude it is the same one
  char command[128];
  snprintf(command, sizeof command, "bicycle cycle roadster --leans %.17g:%.17g:1 --json", lean,
           lean);
  document = run_json(command);
  cycle = json_array_get(json_object_get(document, "cycles"), 0);
  assert_near(run_number(cycle, "speed"), 4.9, 1e-8);
  json_decref(document);
  document = run_json("bicycle cycle roadster --leans 1deg:2deg:2 --speed 6 --json");
  assert_int_equal(json_array_size(at_speed(document)), 0);
  json_decref(document);
  document = run_json("bicycle cycle roadster --leans 1deg:2deg:2 --json");
  assert_true(json_is_null(json_object_get(document, "at_speed")));
  json_decref(document);
}

static void check_branch(const char *bicycle, const char *kind, int rows) {
  char command[128];
  snprintf(command, sizeof command, "bicycle cycle %s --leans 1deg:%ddeg:%d -o branch.svg", bicycle,
           rows, rows);
  run_well(command);
  char *svg = run_read("branch.svg"), *csv = run_read("branch.csv");
  assert_non_null(strstr(svg, kind));
  assert_int_equal(run_occurrences(svg, "<circle"), rows);
  assert_int_equal(run_occurrences(csv, "\n"), rows + 1);
  assert_null(strstr(svg, "nan"));
  free(svg);
  free(csv);
}

static void branch_is_drawn(void **state) {
  (void)state;
  check_branch("roadster", " supercritical", 4);
  check_branch("recumbent", " subcritical", 3);
  run_well("rm branch.svg branch.csv");
  // without a weave speed there is nothing to draw, which is an answer
  run_result result = run_command("bicycle cycle roadster --search 8:20 -o branch.svg; ls");
  assert_non_null(strstr(result.out, "no cycle"));
  assert_non_null(strstr(result.err, "branch.svg not written"));
  assert_null(strstr(result.out, "branch.svg"));
  run_free(&result);
}

static void wrong_command_lines(void **state) {
  (void)state;
  static const run_wrong commands[] = {
      {"bicycle cycle roadster --leans 0:10deg:3", "--leans"},
      {"bicycle cycle roadster --leans 10deg:100deg:3", "--leans"},
      {"bicycle cycle roadster --leans 10deg:1deg:3", "--leans"},
      {"bicycle cycle roadster --search 4", "--search"},
      {"bicycle cycle roadster --search 8:4", "--search"},
      {"bicycle cycle roadster --speed 0", "--speed"},
      {"bicycle cycle roadster --speed -3", "--speed"},
      {"bicycle cycle roadster --speed nan", "--speed"},
      {"bicycle cycle roadster -o branch.png", "-o: 'branch.png'"},
      {"bicycle cycle roadster --leans 1deg:2deg:2 -o nosuch/x.svg", "nosuch/x.svg"},
  };
  run_all_wrong(commands, sizeof commands / sizeof commands[0]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cycles_are_listed),
      cmocka_unit_test(cycles_of_one_speed),
      cmocka_unit_test(branch_is_drawn),
      cmocka_unit_test(wrong_command_lines),
  };
  return cmocka_run_group_tests(tests, run_enter_group, run_leave_group);
}
