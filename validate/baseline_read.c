// SPDX-License-Identifier: Apache-2.0
// A saved report as a baseline: nothing in it is trusted.
#include "baseline.h"

#include "files/text.h"
#include "report.h"
#include "report_read.h"
#include "terminal/message.h"

#include <bicycle/error.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// All shipped scenarios make 1.2 MB; this bounds what a file without an end costs.
static const size_t LARGEST_REPORT = (size_t)64 << 20;

// The file itself, or report.json in a folder; false when out of memory.
static bool report_path(char **out, const char *given) {
  struct stat status;
  bool folder = stat(given, &status) == 0 && S_ISDIR(status.st_mode);
  return asprintf(out, "%s%s", given, folder ? "/report.json" : "") >= 0;
}

typedef struct source {
  FILE *stream;
  size_t left; // bytes that may still come
} source;

static size_t read_more(void *out, size_t size, void *user) {
  source *s = user;
  size_t count = fread(out, 1, size < s->left ? size : s->left, s->stream);
  s->left -= count;
  return count;
}

static term_exit load(json_t **out, const char *path, problem *p) {
  bike_file_error said;
  json_error_t error;
  source s = {NULL, LARGEST_REPORT};
  int code = bike_text_open(&s.stream, path, &said);
  if (code == BIKE_ERROR_MEMORY) return problem_memory(p);
  if (code)
    return problem_set(p, bike_text_is_named_pipe(path) ? TERM_USAGE : TERM_BASELINE, "%s",
                       said.text);
  *out = json_load_callback(read_more, &s, JSON_REJECT_DUPLICATES, &error);
  fclose(s.stream);
  if (term_has_lost()) return problem_memory(p); // it may lack something
  if (*out) return TERM_DONE;
  if (s.left == 0)
    return problem_set(p, TERM_BASELINE, "%s: is larger than %zu bytes", path, LARGEST_REPORT);
  return problem_set(p, TERM_BASELINE, "%s:%d: %s", path, error.line, error.text);
}

static bool is_verdict(const json_t *object) {
  const char *v = report_text(object, "verdict");
  return report_passed(object) || strcmp(v, "fail") == 0 || strcmp(v, "invalid") == 0;
}

// The first key of a gate whose value is of the wrong kind; NULL: none.
static const char *wrong_key_of_gate(const json_t *judged) {
  static const char *const texts[] = {"layer", "signal", "metric"};
  static const char *const bounds[] = {"from", "to"};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
    if (!*report_text(judged, texts[i])) return texts[i];
  const json_t *value = json_object_get(judged, "value");
  if (!json_is_number(value) && !json_is_null(value)) return "value";
  if (!json_is_number(json_object_get(judged, "limit"))) return "limit";
  if (!json_is_boolean(json_object_get(judged, "pass"))) return "pass";
  for (size_t i = 0; i < sizeof bounds / sizeof *bounds; i++) {
    const json_t *bound = json_object_get(judged, bounds[i]);
    if (bound && !json_is_number(bound)) return bounds[i];
  }
  return NULL;
}

static term_exit wrong(problem *p, size_t number, const char *key) {
  return problem_set(p, TERM_BASELINE, "scenarios: number %zu: '%s' is missing or wrong", number,
                     key);
}

static term_exit check_scenario(const json_t *entry, size_t number, problem *p) {
  size_t i;
  const json_t *judged, *gates = json_object_get(entry, "gates");
  if (!*report_text(entry, "name")) return wrong(p, number, "name");
  if (!is_verdict(entry)) return wrong(p, number, "verdict");
  if (!json_is_array(gates)) return wrong(p, number, "gates");
  json_array_foreach(gates, i, judged) {
    const char *key = wrong_key_of_gate(judged);
    if (key)
      return problem_set(p, TERM_BASELINE,
                         "scenarios: number %zu: gates: number %zu: '%s' is missing or wrong",
                         number, i + 1, key);
  }
  return TERM_DONE;
}

static term_exit check_scenarios(const json_t *scenarios, problem *p) {
  size_t i;
  const json_t *entry;
  json_t *seen = json_object();
  term_exit code = seen ? TERM_DONE : problem_memory(p);
  json_array_foreach(scenarios, i, entry) {
    const char *name = report_text(entry, "name");
    if (code == TERM_DONE) code = check_scenario(entry, i + 1, p);
    if (code == TERM_DONE && json_object_get(seen, name))
      code = problem_set(p, TERM_BASELINE, "scenarios: two have the name '%s'", name);
    if (code == TERM_DONE && json_object_set_new(seen, name, json_true())) code = problem_memory(p);
    if (code != TERM_DONE) break;
  }
  json_decref(seen);
  return code;
}

static term_exit check(const json_t *document, problem *p) {
  long long version = json_integer_value(json_object_get(document, "version"));
  const json_t *scenarios = json_object_get(document, "scenarios");
  if (strcmp(report_text(document, "schema"), REPORT_SCHEMA) != 0)
    return problem_set(p, TERM_BASELINE, "schema: is not \"%s\"", REPORT_SCHEMA);
  if (version < 1 || version > REPORT_VERSION)
    return problem_set(p, TERM_BASELINE, "version: %lld, but this program reads 1 to %d", version,
                       REPORT_VERSION);
  if (!is_verdict(document)) return problem_set(p, TERM_BASELINE, "'verdict' is missing or wrong");
  if (!json_is_array(scenarios))
    return problem_set(p, TERM_BASELINE, "'scenarios' is missing or wrong");
  return check_scenarios(scenarios, p);
}

term_exit baseline_read(json_t **out, const char *given, problem *p) {
  char *path;
  *out = NULL;
  if (!report_path(&path, given)) return problem_memory(p);
  term_exit code = load(out, path, p);
  if (code == TERM_DONE) {
    code = check(*out, p);
    if (code != TERM_DONE) problem_prefix(p, code, path);
  }
  if (code != TERM_DONE) {
    json_decref(*out);
    *out = NULL;
  }
  free(path);
  return code;
}
