// SPDX-License-Identifier: Apache-2.0
// The program itself: everything is measured or says why not, peers agree, no time is asserted.
#include "cli/run.h"
#include "support/near.h"

#include <bicycle/batch.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const EXPECTED[] = {
    "rhs-sympy",
    "rhs-sympy-paired",
    "rhs-sympy-reduced",
    "rhs-mujoco",
    "floor-operations",
    "floor-instructions",
    "batch-one",
    "batch-floor",
    "batch-many",
    "jacobian-differences",
    "jacobian-eigenvalues",
    "map-point",
    "map-point-alone",
    "map-differences",
    "ride-lsoda",
    "ride-odeint",
    "ride-solve-ivp",
    "ride-lsoda-default",
    "ride-dop853",
    "ride-dop853-python",
    "ride-mujoco",
    "ride-overhead",
    "ensemble-sundials",
    "ensemble-plain",
    "ensemble-threads",
    "mujoco-step",
    "mujoco-callback",
};

static const char *text(const json_t *object, const char *key) {
  const char *value = json_string_value(json_object_get(object, key));
  if (!value) fail_msg("no text %s", key);
  return value;
}

static const json_t *contest_named(const json_t *document, const char *name) {
  size_t i;
  json_t *contest;
  json_array_foreach(json_object_get(document, "contests"), i, contest) {
    if (!strcmp(text(contest, "name"), name)) return contest;
  }
  fail_msg("no contest %s", name);
  return NULL;
}

// What tests/run.sh installs must be there after it has: a peer that is absent would hide a fault.
static bool all_installed(void) {
  return getenv("BICYCLE_REQUIRE_BROWSER") != NULL;
}

static void check_contest(const json_t *contest) {
  const char *name = text(contest, "name"), *status = text(contest, "status");
  if (strcmp(status, "measured") != 0) {
    if (strcmp(status, "not measured") != 0) fail_msg("%s: %s", name, status);
    if (!text(contest, "reason")[0]) fail_msg("%s: not measured without a reason", name);
    if (all_installed()) fail_msg("%s: %s", name, text(contest, "reason"));
    return;
  }
  if (!(run_number(contest, "ratio") > 0)) fail_msg("%s: ratio", name);
  if (!(run_number(json_object_get(contest, "ours"), "seconds") > 0)) fail_msg("%s: ours", name);
  if (!(run_number(json_object_get(contest, "theirs"), "seconds") > 0))
    fail_msg("%s: theirs", name);
  const char *key;
  json_t *check;
  json_object_foreach(json_object_get(contest, "checks"), key, check) {
    double value = run_number(check, "value"), limit = run_number(check, "limit");
    if (!(value <= limit)) fail_msg("%s: %s is %g, allowed %g", name, key, value, limit);
  }
}

static void all_contests_are_judged(void **state) {
  (void)state;
  json_t *document = run_json("bicycle-bench --quick --json");
  for (size_t i = 0; i < sizeof EXPECTED / sizeof EXPECTED[0]; i++)
    contest_named(document, EXPECTED[i]);
  size_t i;
  json_t *contest;
  json_array_foreach(json_object_get(document, "contests"), i, contest) check_contest(contest);
  const json_t *machine = json_object_get(document, "machine");
  assert_true(text(machine, "cpu")[0] != 0);
  assert_string_equal(text(machine, "instructions"), bike_instructions());
  assert_near(run_number(machine, "lanes"), bike_batch_width(), 0);
  json_decref(document);
}

// How well peers agree must be told, not only kept.
static void agreement_is_told(void **state) {
  (void)state;
  json_t *document = run_json("bicycle-bench --quick --json --only rhs-");
  assert_int_equal(json_array_size(json_object_get(document, "contests")), 4);
  for (size_t i = 0; i < 4; i++) {
    const json_t *checks = json_object_get(contest_named(document, EXPECTED[i]), "checks");
    assert_below(run_number(json_object_get(checks, "disagreement"), "value"), 1e-10);
  }
  json_decref(document);
}

// Whatever is wrong with Python, the rest is measured.
static void absent_python_is_no_error(void **state) {
  (void)state;
  static const char *const PYTHONS[] = {"/nonexistent/python", "/bin/false", "/bin/echo"};
  for (size_t i = 0; i < sizeof PYTHONS / sizeof PYTHONS[0]; i++) {
    char command[256];
    snprintf(command, sizeof command,
             "BICYCLE_BENCH_PYTHON=%s bicycle-bench --quick --json --only ride-", PYTHONS[i]);
    json_t *document = run_json(command);
    const json_t *lsoda = contest_named(document, "ride-lsoda");
    assert_string_equal(text(lsoda, "status"), "not measured");
    assert_true(text(lsoda, "reason")[0] != 0);
    assert_true(json_is_null(json_object_get(lsoda, "ratio")));
    assert_string_equal(text(contest_named(document, "ride-overhead"), "status"), "measured");
    json_decref(document);
  }
}

static void table_and_names(void **state) {
  (void)state;
  run_result table = run_command("bicycle-bench --quick --only mujoco-");
  assert_int_equal(table.status, 0);
  assert_non_null(strstr(table.out, "mujoco-step"));
  assert_non_null(strstr(table.out, "<= 1.8"));
  run_free(&table);
  run_result names = run_command("bicycle-bench --list");
  assert_int_equal(names.status, 0);
  for (size_t i = 0; i < sizeof EXPECTED / sizeof EXPECTED[0]; i++)
    assert_non_null(strstr(names.out, EXPECTED[i]));
  run_free(&names);
}

// The points of the map have nothing to start from.
static void bicycle_without_rider(void **state) {
  (void)state;
  json_t *document = run_json("bicycle-bench roadster_riderless --quick --json --only map-point");
  assert_string_equal(text(contest_named(document, "map-point"), "status"), "not measured");
  json_decref(document);
}

static void wrong_use(void **state) {
  (void)state;
  static const run_wrong WRONG[] = {{"bicycle-bench --only nothing", "--only nothing"},
                                    {"bicycle-bench no.yml", "no.yml"},
                                    {"bicycle-bench --fast", "--fast"}};
  run_all_wrong(WRONG, sizeof WRONG / sizeof WRONG[0]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_contests_are_judged),   cmocka_unit_test(agreement_is_told),
      cmocka_unit_test(absent_python_is_no_error), cmocka_unit_test(table_and_names),
      cmocka_unit_test(bicycle_without_rider),     cmocka_unit_test(wrong_use)};
  return cmocka_run_group_tests(tests, run_enter_group, run_leave_group);
}
