// SPDX-License-Identifier: Apache-2.0
// report.json obeys its published schema, and the schema notices what does not.
#include "json_schema.h"
#include "support/near.h"
#include "validate_support.h"

#include <baseline.h>
#include <report.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static json_t *schema;

static json_t *played(const char *text) {
  support_run *run = support_open(NULL, text);
  report r = {.comparisons = support_play(run), .count = 1};
  assert_true(provenance_begin(&r.provenance, NULL, 0));
  json_t *document = report_document(&r);
  assert_non_null(document);
  provenance_clear(&r.provenance);
  support_close(run);
  return document;
}

static void expect_obedience(const json_t *document) {
  char error[JSON_SCHEMA_ERROR];
  if (!json_schema_check(error, schema, document)) fail_msg("%s", error);
}

static void expect_objection(const json_t *document, const char *message) {
  char error[JSON_SCHEMA_ERROR];
  assert_false(json_schema_check(error, schema, document));
  if (!strstr(error, message)) fail_msg("'%s' instead of '%s'", error, message);
}

static void test_agreeing_report(void **state) {
  (void)state;
  json_t *document = played(support_scenario_text);
  expect_obedience(document);
  json_decref(document);
}

// A run that could not be played has no rides, and null for what it could not measure.
static void test_invalid_report(void **state) {
  (void)state;
  char *text = strdup(support_scenario_text), *speed = strstr(text, "4.6");
  memcpy(speed, "1e9", 3);
  memcpy(strstr(text, "1e-9,"), "1e99,", 5); // L0, so that nothing fails before the ride
  json_t *document = played(text);
  expect_obedience(document);
  json_decref(document);
  free(text);
}

static void test_compared_report(void **state) {
  (void)state;
  json_t *before = played(support_scenario_text), *now = played(support_scenario_text);
  assert_true(baseline_compare(now, before));
  expect_obedience(now);
  json_decref(before);
  json_decref(now);
}

// The report of all shipped scenarios: convergence, horizon, cost and all; its page stays small.
static void test_shipped_scenarios(void **state) {
  (void)state;
  char *folder = support_folder(), *command = NULL, *path = NULL;
  assert_true(asprintf(&command,
                       BICYCLE_BINARY_DIR "/bin/bicycle-validate -o %s/report >%s/out 2>&1", folder,
                       folder) > 0);
  assert_int_equal(system(command), 0);
  assert_true(asprintf(&path, "%s/report/report.json", folder) > 0);
  json_t *document = json_load_file(path, 0, NULL);
  assert_non_null(document);
  expect_obedience(document);
  json_decref(document);
  free(path);
  struct stat page;
  assert_true(asprintf(&path, "%s/report/report.html", folder) > 0);
  assert_int_equal(stat(path, &page), 0);
  assert_true(page.st_size < 3000000); // what may be sent around
  free(command);
  free(path);
  support_remove(folder);
}

static json_t *first(const json_t *object, const char *key) {
  return json_array_get(json_object_get(object, key), 0);
}

// Each change must be noticed, where it was made.
static void test_objections(void **state) {
  (void)state;
  static const struct {
    const char *scenario_key, *gate_key, *value, *message;
  } cases[] = {
      {NULL, NULL, "1.5", "/version: is not the one value"},
      {"verdict", NULL, "\"maybe\"", "/scenarios/0/verdict: is not one of the values"},
      {"surprise", NULL, "1", "/scenarios/0: 'surprise' is not in the schema"},
      {"gates", NULL, "{}", "/scenarios/0/gates: is not of type array"},
      {NULL, "limit", "-1", "/scenarios/0/gates/0/limit: is too small"},
      {NULL, "value", "\"small\"", "/scenarios/0/gates/0/value: is of none of the types"},
      {NULL, "layer", "\"L9\"", "/scenarios/0/gates/0/layer: is not one of the values"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    json_t *document = played(support_scenario_text), *entry = first(document, "scenarios");
    json_t *value = json_loads(cases[i].value, JSON_DECODE_ANY, NULL);
    if (cases[i].gate_key)
      json_object_set_new(first(entry, "gates"), cases[i].gate_key, value);
    else if (cases[i].scenario_key)
      json_object_set_new(entry, cases[i].scenario_key, value);
    else
      json_object_set_new(document, "version", json_real(json_real_value(value)));
    if (!cases[i].gate_key && !cases[i].scenario_key) json_decref(value);
    expect_objection(document, cases[i].message);
    json_decref(document);
  }
  json_t *document = played(support_scenario_text);
  json_object_del(first(first(document, "scenarios"), "gates"), "reason");
  expect_objection(document, "/scenarios/0/gates/0: 'reason' is missing");
  json_decref(document);
}

static void test_unknown_keyword(void **state) {
  (void)state;
  char error[JSON_SCHEMA_ERROR];
  json_t *other = json_pack("{s:i}", "maxItems", 3), *empty = json_array();
  assert_false(json_schema_check(error, other, empty));
  assert_non_null(strstr(error, "maxItems"));
  json_decref(other);
  json_decref(empty);
}

static int load(void **state) {
  (void)state;
  schema = json_load_file(BICYCLE_SOURCE_DIR "/validate/schema/report.schema.json", 0, NULL);
  return schema ? 0 : 1;
}

static int unload(void **state) {
  (void)state;
  json_decref(schema);
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_agreeing_report), cmocka_unit_test(test_invalid_report),
      cmocka_unit_test(test_compared_report), cmocka_unit_test(test_shipped_scenarios),
      cmocka_unit_test(test_objections),      cmocka_unit_test(test_unknown_keyword),
  };
  return cmocka_run_group_tests(tests, load, unload);
}
