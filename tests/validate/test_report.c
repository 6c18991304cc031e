// SPDX-License-Identifier: Apache-2.0
// The report: its structure, that it is the same twice, and what its folder may replace.
#include "junit_check.h"
#include "support/near.h"
#include "validate_support.h"

#include <dirent.h>
#include <folder.h>
#include <report.h>
#include <report_markup.h>
#include <report_pack.h>
#include <report_read.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// A run of the test scenario with a text that may be changed, in a folder of its own.
typedef struct fixture {
  char *home, *target;
  scenario scenario;
  comparison comparison;
  report report;
} fixture;

static fixture *open_named_fixture(const char *text, const char *name) {
  fixture *f = calloc(1, sizeof *f);
  problem p = {""};
  assert_non_null(f);
  f->home = support_folder();
  assert_true(asprintf(&f->target, "%s/report", f->home) > 0);
  char *path = support_write(f->home, name, text);
  assert_int_equal(scenario_read(&f->scenario, path, &p), TERM_DONE);
  free(path);
  assert_int_equal(comparison_open(&f->comparison, &f->scenario, &p), TERM_DONE);
  assert_int_equal(comparison_run(&f->comparison, &p), TERM_DONE);
  char argument[] = "it's mine\xff.yml"; // no UTF-8
  char *arguments[] = {argument};
  assert_true(provenance_begin(&f->report.provenance, arguments, 1));
  f->report.comparisons = &f->comparison;
  f->report.count = 1;
  return f;
}

static fixture *open_fixture(const char *text) {
  return open_named_fixture(text, "test.yml");
}

static void close_fixture(fixture *f) {
  provenance_clear(&f->report.provenance);
  comparison_close(&f->comparison);
  scenario_clear(&f->scenario);
  support_remove(f->home);
  free(f->target);
  free(f);
}

static char *beside(const fixture *f, const char *name) {
  char *path = NULL;
  assert_true(asprintf(&path, "%s/%s", f->target, name) > 0);
  return path;
}

static term_exit write_report(const fixture *f, const char *path, problem *p) {
  json_t *document = report_document(&f->report);
  assert_non_null(document);
  term_exit code = report_write(&f->report, document, path, p);
  json_decref(document);
  return code;
}

static json_t *load_report(const fixture *f) {
  char *path = beside(f, "report.json");
  json_t *document = json_load_file(path, 0, NULL);
  assert_non_null(document);
  free(path);
  return document;
}

static int count_entries(const char *path) {
  int count = 0;
  DIR *open = opendir(path);
  assert_non_null(open);
  while (readdir(open)) count++;
  closedir(open);
  return count - 2; // "." and ".."
}

static const char *text_of(const json_t *object, const char *key) {
  return json_string_value(json_object_get(object, key));
}

static void check_gate(const json_t *g) {
  assert_true(json_is_string(json_object_get(g, "layer")));
  assert_true(json_is_string(json_object_get(g, "signal")));
  assert_true(json_is_string(json_object_get(g, "metric")));
  assert_true(json_is_real(json_object_get(g, "value")));
  assert_true(json_is_real(json_object_get(g, "limit")));
  assert_true(json_is_true(json_object_get(g, "pass")));
  assert_true(json_real_value(json_object_get(g, "value")) <=
              json_real_value(json_object_get(g, "limit")));
}

static void test_structure(void **state) {
  (void)state;
  fixture *f = open_fixture(support_scenario_text);
  problem p = {""};
  assert_int_equal(write_report(f, f->target, &p), TERM_DONE);
  json_t *document = load_report(f);
  assert_string_equal(text_of(document, "schema"), REPORT_SCHEMA);
  assert_int_equal(json_integer_value(json_object_get(document, "version")), REPORT_VERSION);
  assert_string_equal(text_of(document, "verdict"), "agree");
  assert_true(json_is_null(json_object_get(document, "first_failure")));
  const json_t *scenarios = json_object_get(document, "scenarios");
  assert_int_equal(json_array_size(scenarios), 1);
  const json_t *s = json_array_get(scenarios, 0);
  assert_string_equal(text_of(s, "name"), "test");
  assert_string_equal(text_of(s, "bicycle"), "benchmark");
  assert_string_equal(text_of(s, "verdict"), "agree");
  const json_t *gates = json_object_get(s, "gates");
  assert_int_equal(json_array_size(gates), f->comparison.gates.count);
  for (size_t i = 0; i < json_array_size(gates); i++) check_gate(json_array_get(gates, i));
  const json_t *origin = json_object_get(document, "provenance");
  assert_string_equal(text_of(origin, "command"), "bicycle validate 'it'\\''s mine\ufffd.yml'");
  assert_non_null(text_of(origin, "compiler"));
  assert_non_null(text_of(origin, "cpu"));
  const json_t *engines = json_object_get(s, "engines");
  assert_non_null(strstr(text_of(json_array_get(engines, 1), "version"), "MuJoCo 2.2"));
  assert_int_equal(strlen(text_of(json_array_get(engines, 1), "model_sha256")), 64);
  assert_int_equal(strlen(text_of(s, "parameter_sha256")), 64);
  json_decref(document);
  close_fixture(f);
}

static void test_failure_is_told(void **state) {
  (void)state;
  char *text = strdup(support_scenario_text), *limit = strstr(text, "limit: 1e-11");
  memcpy(limit, "limit: 1e-22", strlen("limit: 1e-22"));
  fixture *f = open_fixture(text);
  json_t *document = report_document(&f->report);
  assert_string_equal(text_of(document, "verdict"), "fail");
  assert_string_equal(text_of(document, "first_failure"), "L2");
  assert_non_null(strstr(text_of(document, "cause"), "steer"));
  assert_int_equal(verdict_exit(report_verdict(&f->report)), 1);
  json_decref(document);
  close_fixture(f);
  free(text);
}

// Takes away what may differ between two runs.
static char *timeless(json_t *document) {
  json_t *origin = json_object_get(document, "provenance");
  json_object_del(origin, "created");
  json_object_del(origin, "timings");
  char *text = json_dumps(document, JSON_REAL_PRECISION(17));
  json_decref(document);
  assert_non_null(text);
  return text;
}

static void test_same_twice(void **state) {
  (void)state;
  char *text[2];
  for (int i = 0; i < 2; i++) {
    fixture *f = open_fixture(support_scenario_text);
    text[i] = timeless(report_document(&f->report));
    close_fixture(f);
  }
  assert_string_equal(text[0], text[1]);
  free(text[0]);
  free(text[1]);
}

static void test_csv(void **state) {
  (void)state;
  fixture *f = open_fixture(support_scenario_text);
  problem p = {""};
  assert_int_equal(write_report(f, f->target, &p), TERM_DONE);
  static const char *const names[] = {"test-analytic.csv", "test-mujoco.csv", "test-residuals.csv"};
  for (int i = 0; i < 3; i++) {
    char *path = beside(f, names[i]), *text = support_read(path);
    assert_non_null(text);
    assert_ptr_equal(strstr(text, "time,x,y,yaw,lean,pitch,steer,lean_rate,steer_rate,speed,"),
                     text);
    assert_true((strstr(text, "rear_slip") != NULL) == (i == 1));
    int lines = 0;
    for (const char *c = text; *c; c++) lines += *c == '\n';
    assert_int_equal(lines, 52);
    free(text);
    free(path);
  }
  close_fixture(f);
}

static void expect_part(const char *text, const char *part) {
  if (!strstr(text, part)) fail_msg("no '%s'", part);
}

static char *view_of(const fixture *f, const char *name) {
  char *path = beside(f, name), *text = support_read(path);
  assert_non_null(text);
  free(path);
  return text;
}

static char *escaped(const char *text) {
  char *out = NULL;
  size_t size;
  FILE *stream = open_memstream(&out, &size);
  assert_non_null(stream);
  report_escape(stream, text);
  assert_int_equal(fclose(stream), 0);
  return out;
}

// A title that every kind of markup would take for its own, and a gate that fails.
static const char hostile[] = "title: '</script><b>&\"|x'";

static void test_views_escape(void **state) {
  (void)state;
  char *text = NULL;
  assert_true(asprintf(&text, "%s%s", hostile, strchr(support_scenario_text, '\n')) > 0);
  char *limit = strstr(text, "limit: 1e-11");
  memcpy(limit, "limit: 1e-22", strlen("limit: 1e-22"));
  fixture *f = open_fixture(text);
  problem p = {""};
  assert_int_equal(write_report(f, f->target, &p), TERM_DONE);
  char *html = view_of(f, "report.html"), *junit = view_of(f, "junit.xml");
  char *summary = view_of(f, "summary.md");
  assert_null(strstr(html, "</script><b>"));
  expect_part(html, "&lt;/script&gt;&lt;b&gt;&amp;&quot;|x");
  expect_part(html, "<h1>Fail");
  expect_part(html, "default-src 'none'");
  expect_part(junit, "tests=\"");
  expect_part(junit, "<failure message=\"");
  expect_part(junit, "classname=\"test.L2\" name=\"lean max\"");
  // A reader of the failure alone learns the cause.
  char *cause = escaped(f->comparison.cause), *message = NULL;
  assert_true(asprintf(&message, " rad, limit 1e-22 rad, at 0.5 s: %s\">", cause) > 0);
  expect_part(junit, message);
  free(cause);
  free(message);
  junit_check(junit);
  expect_part(summary, "## Fail: 1 scenario fails; 2 of ");
  expect_part(summary, "\\</script\\>\\<b\\>\\&\"\\|x");
  expect_part(summary, "- `L2 lean max`: ");
  free(html);
  free(junit);
  free(summary);
  close_fixture(f);
  free(text);
}

// The text between two others.
static char *between(const char *text, const char *before, const char *after) {
  const char *begin = strstr(text, before);
  assert_non_null(begin);
  begin += strlen(before);
  const char *end = strstr(begin, after);
  assert_non_null(end);
  return strndup(begin, (size_t)(end - begin));
}

// What a browser makes of a link: %XX undone.
static char *decoded(const char *link) {
  char *out = calloc(1, strlen(link) + 1), *to = out;
  unsigned byte;
  for (const char *at = link; *at; at++) {
    assert_null(strchr(" #?<>\"'\\:;&", *at));
    if (*at == '%') {
      assert_int_equal(sscanf(at + 1, "%2x", &byte), 1);
      *to++ = (char)byte;
      at += 2;
    } else {
      *to++ = *at;
    }
  }
  return out;
}

// Links lead to the scenario and its files whatever the scenario is called; the page's own marks
// are no scenario's name; what is not UTF-8 does not keep the report from being written.
static void test_links_of_odd_names(void **state) {
  (void)state;
  static const struct {
    const char *file, *name;
  } names[] = {{"50%25 #1?.yml", "50%25 #1?"},
               {"a'b\"<&c>;.yml", "a'b\"<&c>;"},
               {"javascript:x.yml", "javascript:x"},
               {"\u00fc \u6b21.yml", "\u00fc \u6b21"},
               {"json.yml", "json"},
               {"x\xff\ty.yml", "x??y"}};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    fixture *f = open_named_fixture(support_scenario_text, names[i].file);
    problem p = {""};
    assert_int_equal(write_report(f, f->target, &p), TERM_DONE);
    char *html = view_of(f, "report.html"), *id = escaped(names[i].name), *section = NULL;
    assert_true(asprintf(&section, "<section class=scenario id='%s'>", id) > 0);
    expect_part(html, section);
    assert_null(strstr(html, "id=json"));
    char *link = between(html, "Closest to its limit: <a href='#", "'"), *name = decoded(link);
    assert_string_equal(name, names[i].name);
    char *file_link = between(html, "beside this page: <a href='", "'");
    char *file = decoded(file_link), *path = beside(f, file);
    assert_int_equal(access(path, R_OK), 0);
    char *junit = view_of(f, "junit.xml");
    junit_check(junit);
    char *const texts[] = {html, id, section, link, name, file_link, file, path, junit};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) free(texts[k]);
    close_fixture(f);
  }
}

// The closest gate of all is of a part of the ride, and the page says so.
static void test_page_names_the_part(void **state) {
  (void)state;
  char *text = support_replace(support_scenario_text, "signals: [lean, steer], limit: 1e-11",
                               "signals: [lean], limit: 1e-12, from: 0.1, to: 0.4");
  fixture *f = open_fixture(text);
  problem p = {""};
  assert_int_equal(write_report(f, f->target, &p), TERM_DONE);
  char *html = view_of(f, "report.html");
  expect_part(html, "Closest to its limit: ");
  expect_part(html, "</a>, L2 lean max (0.1 to 0.4 s): ");
  free(html);
  close_fixture(f);
  free(text);
}

// Failures first, a NaN before all, then by what is used of the limit; ties as measured.
static void test_gates_by_margin(void **state) {
  (void)state;
  static const char entry[] =
      "{\"gates\": [{\"signal\": \"a\", \"value\": 1, \"limit\": 4, \"pass\": true},"
      "{\"signal\": \"b\", \"value\": 3, \"limit\": 4, \"pass\": true},"
      "{\"signal\": \"c\", \"value\": 5, \"limit\": 4, \"pass\": false},"
      "{\"signal\": \"d\", \"value\": null, \"limit\": 4, \"pass\": false},"
      "{\"signal\": \"e\", \"value\": 0, \"limit\": 0, \"pass\": true},"
      "{\"signal\": \"f\", \"value\": 1, \"limit\": 4, \"pass\": true}]}";
  json_t *document = json_loads(entry, 0, NULL);
  size_t count;
  report_gate *gates = report_gates_by_margin(document, &count);
  char order[8] = "";
  assert_int_equal(count, 6);
  for (size_t i = 0; i < count; i++) order[i] = *gates[i].signal;
  assert_string_equal(order, "dcbafe");
  assert_int_equal(report_failed_gates(document), 2);
  free(gates);
  json_decref(document);
}

// A run without rides has a page too, and one test that says why.
static void test_views_of_invalid_run(void **state) {
  (void)state;
  char *text = strdup(support_scenario_text), *speed = strstr(text, "4.6");
  memcpy(speed, "1e9", 3);
  memcpy(strstr(text, "1e-9,"), "1e99,", 5); // L0, so that nothing fails before the ride
  fixture *f = open_fixture(text);
  problem p = {""};
  assert_int_equal(f->comparison.verdict, VERDICT_INVALID);
  assert_int_equal(write_report(f, f->target, &p), TERM_DONE);
  char *html = view_of(f, "report.html"), *junit = view_of(f, "junit.xml");
  expect_part(html, "<h1>Invalid");
  expect_part(html, "There is no ride to show");
  expect_part(junit, "errors=\"1\"");
  expect_part(junit, "<error message=\"");
  junit_check(junit);
  free(html);
  free(junit);
  close_fixture(f);
  free(text);
}

// Of many long rides only every other row goes into the page, and the page says so.
static void test_page_is_thinned(void **state) {
  (void)state;
  enum { COPIES = 400 }; // of 51 rows each: more than a page holds
  fixture *f = open_fixture(support_scenario_text);
  comparison *copies = calloc(COPIES, sizeof *copies);
  char *text = NULL;
  size_t size;
  assert_non_null(copies);
  for (int i = 0; i < COPIES; i++) copies[i] = f->comparison;
  report many = {.comparisons = copies, .count = COPIES};
  assert_int_equal(report_pack_stride(&f->report), 1);
  assert_int_equal(report_pack_stride(&many), 2);
  FILE *stream = open_memstream(&text, &size);
  assert_non_null(stream);
  assert_true(report_pack(stream, &f->comparison, 2));
  assert_int_equal(fclose(stream), 0);
  expect_part(text, "\"rows\":26,\"step\":0.02,\"stride\":2");
  json_t *packed = json_loads(text, 0, NULL);
  assert_non_null(packed);
  json_decref(packed);
  free(text);
  free(copies);
  close_fixture(f);
}

static void test_earlier_report_is_replaced(void **state) {
  (void)state;
  fixture *f = open_fixture(support_scenario_text);
  problem p = {""};
  for (int i = 0; i < 3; i++) {
    assert_int_equal(write_report(f, f->target, &p), TERM_DONE);
    assert_int_equal(count_entries(f->target), 3 + REPORT_VIEWS);
    assert_int_equal(count_entries(f->home), 2); // the scenario and the report: nothing aside
  }
  close_fixture(f);
}

static void expect_refusal(const fixture *f, const char *path, const char *message) {
  problem p = {""};
  int entries = count_entries(f->home);
  assert_int_equal(folder_check(path, &p), TERM_USAGE);
  assert_int_equal(write_report(f, path, &p), TERM_USAGE);
  if (!strstr(p.text, message)) fail_msg("'%s' instead of '%s'", p.text, message);
  assert_int_equal(count_entries(f->home), entries);
}

static void test_nothing_else_is_replaced(void **state) {
  (void)state;
  fixture *f = open_fixture(support_scenario_text);
  problem p = {""};
  char *file = support_write(f->home, "plain", "text");
  expect_refusal(f, file, "not a folder");
  char *below = NULL, *nowhere = NULL;
  assert_true(asprintf(&below, "%s/report", file) > 0);
  assert_true(asprintf(&nowhere, "%s/none/report", f->home) > 0);
  expect_refusal(f, below, "Not a directory");
  expect_refusal(f, nowhere, "No such file");
  expect_refusal(f, "", "empty");
  expect_refusal(f, f->home, "is not a report");
  assert_int_equal(write_report(f, f->target, &p), TERM_DONE);
  char *notes = support_write(f->target, "notes.txt", "mine");
  expect_refusal(f, f->target, "notes.txt");
  char *kept = support_read(notes);
  assert_string_equal(kept, "mine");
  free(kept);
  free(notes);
  free(file);
  free(below);
  free(nowhere);
  close_fixture(f);
}

static void test_empty_folder_and_link(void **state) {
  (void)state;
  fixture *f = open_fixture(support_scenario_text);
  problem p = {""};
  char *link = NULL, *slashes = NULL;
  assert_int_equal(mkdir(f->target, 0777), 0);
  assert_true(asprintf(&link, "%s/link", f->home) > 0);
  assert_true(asprintf(&slashes, "%s//", f->target) > 0);
  assert_int_equal(symlink("report", link), 0);
  assert_int_equal(write_report(f, link, &p), TERM_DONE);
  assert_int_equal(write_report(f, slashes, &p), TERM_DONE);
  struct stat status;
  assert_int_equal(lstat(link, &status), 0);
  assert_true(S_ISLNK(status.st_mode));
  assert_int_equal(count_entries(f->target), 3 + REPORT_VIEWS);
  free(link);
  free(slashes);
  close_fixture(f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_structure),
      cmocka_unit_test(test_failure_is_told),
      cmocka_unit_test(test_same_twice),
      cmocka_unit_test(test_csv),
      cmocka_unit_test(test_views_escape),
      cmocka_unit_test(test_links_of_odd_names),
      cmocka_unit_test(test_page_names_the_part),
      cmocka_unit_test(test_gates_by_margin),
      cmocka_unit_test(test_views_of_invalid_run),
      cmocka_unit_test(test_page_is_thinned),
      cmocka_unit_test(test_earlier_report_is_replaced),
      cmocka_unit_test(test_nothing_else_is_replaced),
      cmocka_unit_test(test_empty_folder_and_link),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
