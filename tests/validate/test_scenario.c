// SPDX-License-Identifier: Apache-2.0
// Broken scenario files: one line that names file, line and key, and exit code 2.
#include "support/near.h"
#include "validate_support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char head[] = "title: t\nbicycle: benchmark\nstart: {speed: 5}\nduration: 1\n"
                           "sample: 0.1\nreference: {engine: analytic}\n";
static const char candidate[] = "candidate: {engine: mujoco}\n";
static const char gates[] = "gates:\n"
                            "  - {layer: L2, metric: max, signals: [lean], limit: 1, reason: r}\n";

// A file that is right but for `text`, which replaces `without` or, where that is NULL, is added
// at the end; and what the message must hold.
typedef struct broken {
  const char *without, *text, *message;
} broken;

static const broken cases[] = {
    {NULL, "colour: red\n", ":10: colour: unknown key"},
    {NULL, "duration: 2\n", ":10: duration: given twice"},
    {"title: t\n", "", "key 'title' is missing"},
    {"start: {speed: 5}\n", "", "key 'start' is missing"},
    {"gates:", "gatse:", ":8: gatse: unknown key"},
    {"duration: 1\n", "duration: .nan\n", ":4: duration: '.nan' is not finite"},
    {"duration: 1\n", "duration: 1e999\n", ":4: duration: '1e999' is too large"},
    {"duration: 1\n", "duration: 1.5abc\n", ":4: duration: '1.5abc' is not a number"},
    {"duration: 1\n", "duration: \"1\"\n", ":4: duration: must be a number"},
    {"duration: 1\n", "duration: [1]\n", ":4: duration: must be a number"},
    {"duration: 1\n", "duration: -1\n", ":4: duration: must be positive"},
    {"duration: 1\n", "duration:\n", ":4: duration: must be a number"},
    {"sample: 0.1\n", "sample: 0\n", ":5: sample: must be positive"},
    {"sample: 0.1\n", "sample: 2\n", ":5: sample: is longer than the duration"},
    {"sample: 0.1\n", "sample: 1e-9\n", ":5: sample: asks for more than"},
    {"bicycle: benchmark\n", "bicycle: tandem\n", ":2: bicycle: "},
    {"bicycle: benchmark\n", "bicycle: ./none.yml\n", "none.yml: No such file"},
    {"bicycle: benchmark\n", "bicycle: 7\n", ":2: bicycle: "},
    {"start: {speed: 5}\n", "start: {lean: 0}\n", ":3: start: key 'speed' is missing"},
    {"start: {speed: 5}\n", "start: {speed: 5, sped: 4}\n", ":3: sped: unknown key"},
    {"start: {speed: 5}\n", "start: 5\n", ":3: start: must hold"},
    {"start: {speed: 5}\n", "start: {speed: inf}\n", ":3: speed: 'inf' is not finite"},
    {"start: {speed: 5}\n", "start: {speed: 5, steer: 1e12}\n",
     ":3: steer: must be in radians, within 100 turns"},
    {"start: {speed: 5}\n", "start: {speed: 5, steer: -629}\n", ":3: steer: must be in radians"},
    {"start: {speed: 5}\n", "start: {speed: 5, lean: 1e300}\n", ":3: lean: must be in radians"},
    {NULL, "instants: {count: 1, lean: 0.1, steer: 1e9}\n", ":10: steer: must be in radians"},
    {NULL, "instants: {count: 1, lean: 1e9, steer: 0.1}\n", ":10: lean: must be in radians"},
    {"start: {speed: 5}\n", "start: {speed: 5,\n  lean: 1.5707963}\n",
     ":4: lean: 1.5708 rad is too much: rides end at a lean of 1.39626 rad"},
    {"start: {speed: 5}\n", "start: {speed: 5, lean: -1.5}\n", ":3: lean: -1.5 rad is too much"},
    {"start: {speed: 5}\n", "start: {speed: 5, lean: 1.3962634015954636}\n",
     ":3: lean: 1.39626 rad is too much"},
    {"{engine: mujoco}", "{engine: ode}", ":7: engine: 'ode' is not an engine"},
    {"{engine: mujoco}", "{timestep: 1}", ":7: candidate: key 'engine' is missing"},
    {"{engine: mujoco}", "mujoco", ":7: candidate: must hold"},
    {"{engine: mujoco}", "{engine: mujoco, step: 1}", ":7: step: the engine 'mujoco' has no such"},
    {"{engine: mujoco}", "{engine: mujoco, timestep: 0}", ":7: timestep: must be positive"},
    {"{engine: mujoco}", "{engine: mujoco, timestep: 1, timestep: 1}", ":7: timestep: given twice"},
    {"{engine: mujoco}", "{engine: mujoco, integrator: rk5}", "'rk5' is none of rk4, euler, impl"},
    {"layer: L2", "layer: L9", ":9: layer: 'L9' is not a layer"},
    {"metric: max", "metric: maximum", ":9: gates: layer L2 has no metric 'maximum'"},
    {"[lean]", "[leen]", ":9: gates: layer L2 has no signal 'leen'"},
    {"[lean]", "[]", ":9: signals: must name a signal"},
    {"[lean]", "lean", ":9: signals: must be a list"},
    {"limit: 1,", "limit: -1,", ":9: limit: must not be negative"},
    {"limit: 1,", "limit: nan,", ":9: limit: 'nan' is not finite"},
    {", reason: r", "", ":9: gates: key 'reason' is missing"},
    {"limit: 1, ", "", ":9: gates: key 'limit' is missing"},
    {"limit: 1, ", "info: false, ", ":9: gates: key 'limit' is missing"},
    {"limit: 1,", "info: true,", "nothing is judged"},
    {"limit: 1,", "limit: 1, info: 1,", ":9: info: "},
    {"limit: 1,", "limit: 1, form: 1,", ":9: form: unknown key"},
    {"limit: 1,", "limit: 1, from: -1,", ":9: from: must not be negative"},
    {"limit: 1,", "limit: 1, to: 0,", ":9: to: must be positive"},
    {"limit: 1,", "limit: 1, to: nan,", ":9: to: 'nan' is not finite"},
    {"limit: 1,", "limit: 1,\n     from: 0.6, to: 0.5,",
     ":10: from: 0.6 s is later than 'to', 0.5"},
    {"limit: 1,", "limit: 1,\n     from: 2,", ":10: from: 2 s is after the end of the ride, 1 s"},
    {"limit: 1,", "info: true, from: 1.001,", ":9: from: 1.001 s is after the end of the ride, 1"},
    {"limit: 1,", "limit: 1, from: 0.32, to: 0.38,",
     ":9: from: no row lies from 0.32 to 0.38 s: there is one every 0.1 s"},
    {"sample: 0.1\n",
     "sample: 0.3\ngates:\n  - {layer: L2, metric: max, limit: 1, from: 0.91, to: 7, "
     "reason: r}\n",
     ":7: from: no row lies from 0.91 to 1 s: there is one every 0.3"},
    {"title: t\n", "gates:\n  - {layer: L2, metric: max, limit: 1, from: 2, reason: r}\n",
     ":2: from: 2 s is after"}, // of a ride of which nothing was read yet
    {gates, "include: [late.yml]\n", ":8: include: "},
    {gates, "include: [late.yml]\n", "late.yml:3: from: 5 s is after the end of the ride, 1 s"},
    {"L2, metric: max, signals: [lean]", "L3, metric: max, from: 0.1",
     ":9: from: the metric 'max' of layer L3 has no window"},
    {"metric: max, signals: [lean]", "metric: difference, to: 0.1", ":9: to: the metric 'diff"},
    {"limit: 1,", "limit: 1, nominal: 1,", ":9: nominal: only the metric 'nrmse' has it"},
    {"max, signals: [lean]", "nrmse, nominal: 0", ":9: nominal: must be positive"},
    {"limit: 1,", "limit: 1, time_tolerance: 0,", ":9: time_tolerance: only the metric 'tube'"},
    {"gates:\n", "gates:\n  - max\n", ":9: gates: must hold"},
    {gates, "", "nothing is judged"},
    {NULL, "include: [more.yml]\n", ":10: include: must stand before 'gates'"},
    {gates, "include: [more.yml]\n", "more.yml: No such file"},
    {gates, "include: more.yml\n", ":8: include: must be a list"},
    {gates, "include: [test.yml]\n", "test.yml:1: title: unknown key"},
    {NULL, "growth: fast\n", ":10: growth: 'fast' is not a number"},
    {NULL, "growth: -1\n", ":10: growth: must not be negative"},
    {NULL, "instants: {count: 1.5}\n", ":10: count: must be a whole number"},
    {NULL, "instants: {seed: -1}\n", ":10: seed: must not be negative"},
    {NULL, "instants: {slow: 9, fast: 1}\n", ":10: instants: 'slow' is above 'fast'"},
    {NULL, "start: {speed: 5\n", "test.yml:1"},
    {NULL, "---\ntitle: again\n", "more than one YAML document"},
    {"title: t\n", "title: &a t\n", ":1: title: anchors are not accepted"},
};

// The right file with one thing changed.
static char *text_of(const broken *b) {
  char *whole = NULL, *text = NULL;
  assert_true(asprintf(&whole, "%s%s%s", head, candidate, gates) > 0);
  const char *at = b->without ? strstr(whole, b->without) : whole + strlen(whole);
  assert_non_null(at);
  const char *rest = at + (b->without ? strlen(b->without) : 0);
  assert_true(asprintf(&text, "%.*s%s%s", (int)(at - whole), whole, b->text, rest) > 0);
  free(whole);
  return text;
}

static void expect_usage(const char *path, const char *message) {
  scenario s;
  problem p = {""};
  term_exit code = scenario_read(&s, path, &p);
  if (code != TERM_USAGE || !strstr(p.text, message))
    fail_msg("exit %d, '%s' instead of '%s'", code, p.text, message);
  assert_null(strchr(p.text, '\n'));
  assert_non_null(strstr(p.text, path));
}

static void test_broken_files(void **state) {
  (void)state;
  char *folder = support_folder();
  free(support_write(folder, "late.yml",
                     "gates:\n  - {layer: L2, metric: max, limit: 1, reason: r,\n     from: 5}\n"));
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char *text = text_of(&cases[i]), *path = support_write(folder, "test.yml", text);
    expect_usage(path, cases[i].message);
    free(text);
    free(path);
  }
  support_remove(folder);
}

static void test_not_even_yaml(void **state) {
  (void)state;
  char *folder = support_folder();
  static const char *const texts[][2] = {
      {"", "is empty"}, {"- 1\n", "key: value"}, {"a: [1\n", "test.yml:"}, {"\001", "text file"}};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    char *path = support_write(folder, "test.yml", texts[i][0]);
    expect_usage(path, texts[i][1]);
    free(path);
  }
  expect_usage(folder, "directory");
  expect_usage("/nowhere/test.yml", "No such file");
  support_remove(folder);
}

static void test_right_file(void **state) {
  (void)state;
  char *folder = support_folder(), *text = text_of(&(broken){NULL, "", NULL});
  scenario s;
  support_read_scenario(&s, folder, text);
  assert_string_equal(s.name, "test");
  assert_string_equal(s.bicycle_name, "benchmark");
  assert_near(s.start.speed, 5, 0);
  assert_near(s.start.lean, 0, 0);
  assert_int_equal(s.rules.count, 1);
  assert_ptr_equal(s.candidate.engine, &engine_mujoco);
  assert_true(s.instants.count > 0);
  scenario_clear(&s);
  free(text);
  support_remove(folder);
}

// Windows with a row of the ride, which is at 0, 0.1 ... 1 s, and no more than that.
static void test_right_windows(void **state) {
  (void)state;
  static const char *const windows[] = {
      "from: 1",  "from: 1.00000001",  "from: 0.3, to: 0.3", "from: 0.95", "from: 0.61, to: 0.7",
      "to: 0.01", "from: 0, to: 0.01", "from: 0.5, to: 7"};
  char *folder = support_folder();
  for (size_t i = 0; i < sizeof windows / sizeof *windows; i++) {
    char limit[64];
    snprintf(limit, sizeof limit, "limit: 1, %s,", windows[i]);
    char *text = text_of(&(broken){"limit: 1,", limit, NULL});
    scenario s;
    support_read_scenario(&s, folder, text);
    assert_int_equal(s.rules.count, 1);
    scenario_clear(&s);
    free(text);
  }
  support_remove(folder);
}

// Other files are found beside the scenario, wherever the program runs.
static void test_files_beside(void **state) {
  (void)state;
  char *folder = support_folder();
  char *shipped = support_read(BICYCLE_SOURCE_DIR "/model/roadster/roadster.yml");
  assert_non_null(shipped);
  char *bicycle = support_write(folder, "mine.yml", shipped);
  char *shared = support_write(folder, "shared.yml", gates);
  scenario s;
  support_read_scenario(&s, folder,
                        "title: t\nbicycle: ./mine.yml\nstart: {speed: 5}\nduration: 1\n"
                        "sample: 0.1\nreference: {engine: analytic}\n"
                        "candidate: {engine: mujoco}\ninclude: [shared.yml]\n"
                        "gates:\n  - {layer: L3, metric: max, limit: 1, reason: r}\n");
  assert_int_equal(s.rules.count, 2);
  assert_string_equal(s.rules.items[0].signals[0], "lean");
  assert_int_equal(s.rules.items[1].signal_count, 0);
  assert_near(s.model.total_mass, 89, 1e-12);
  scenario_clear(&s);
  free(shipped);
  free(bicycle);
  free(shared);
  support_remove(folder);
}

static void test_shipped(void **state) {
  (void)state;
  char **paths = NULL;
  size_t count = 0;
  problem p = {""};
  assert_int_equal(scenario_list(&paths, &count, &p), TERM_DONE);
  assert_true(count >= 8);
  for (size_t i = 0; i < count; i++) {
    scenario s;
    char found[SCENARIO_PATH];
    assert_int_equal(scenario_read(&s, paths[i], &p), TERM_DONE);
    assert_int_equal(scenario_find(found, s.name, &p), TERM_DONE);
    assert_string_equal(found, paths[i]);
    scenario_clear(&s);
    free(paths[i]);
  }
  free(paths);
  char found[SCENARIO_PATH];
  assert_int_equal(scenario_find(found, "nonsense", &p), TERM_USAGE);
  assert_int_equal(scenario_find(found, "./nonsense", &p), TERM_DONE); // reading it fails
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_broken_files), cmocka_unit_test(test_not_even_yaml),
      cmocka_unit_test(test_right_file),   cmocka_unit_test(test_right_windows),
      cmocka_unit_test(test_files_beside), cmocka_unit_test(test_shipped),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
