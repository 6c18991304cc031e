// SPDX-License-Identifier: Apache-2.0
#include "baseline.h"

#include "report.h"
#include "report_read.h"
#include "terminal/json.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// The file itself, or report.json in a folder; false when out of memory.
static bool report_path(char **out, const char *given) {
  struct stat status;
  bool folder = stat(given, &status) == 0 && S_ISDIR(status.st_mode);
  return asprintf(out, "%s%s", given, folder ? "/report.json" : "") >= 0;
}

static json_t *load(const char *path, problem *p) {
  json_error_t error;
  FILE *stream = fopen(path, "re");
  if (!stream) {
    problem_set(p, TERM_BASELINE, "%s: %s", path, strerror(errno));
    return NULL;
  }
  json_t *document = json_loadf(stream, 0, &error);
  if (!document) problem_set(p, TERM_BASELINE, "%s:%d: %s", path, error.line, error.text);
  fclose(stream);
  return document;
}

static bool is_scenario(const json_t *entry) {
  size_t i;
  const json_t *judged, *gates = json_object_get(entry, "gates");
  json_array_foreach(gates, i, judged) {
    if (!json_is_object(judged)) return false;
  }
  return json_is_array(gates);
}

static term_exit check_schema(const json_t *document, const char *path, problem *p) {
  long long version = json_integer_value(json_object_get(document, "version"));
  if (strcmp(report_text(document, "schema"), REPORT_SCHEMA) != 0)
    return problem_set(p, TERM_BASELINE, "%s: schema: is not \"%s\"", path, REPORT_SCHEMA);
  if (version != REPORT_VERSION)
    return problem_set(p, TERM_BASELINE, "%s: version: %lld, but this program writes %d", path,
                       version, REPORT_VERSION);
  size_t i;
  const json_t *entry, *scenarios = json_object_get(document, "scenarios");
  if (!json_is_array(scenarios))
    return problem_set(p, TERM_BASELINE, "%s: scenarios: missing", path);
  json_array_foreach(scenarios, i, entry) {
    if (!is_scenario(entry))
      return problem_set(p, TERM_BASELINE, "%s: scenarios: number %zu is none", path, i + 1);
  }
  return TERM_DONE;
}

term_exit baseline_read(json_t **out, const char *given, problem *p) {
  char *path;
  if (!report_path(&path, given)) return problem_memory(p);
  *out = load(path, p);
  term_exit code = *out ? check_schema(*out, path, p) : TERM_BASELINE;
  if (code != TERM_DONE) {
    json_decref(*out);
    *out = NULL;
  }
  free(path);
  return code;
}

static json_t *entry_named(const json_t *document, const char *name) {
  size_t i;
  json_t *entry;
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    if (strcmp(report_text(entry, "name"), name) == 0) return entry;
  }
  return NULL;
}

// Also where both have no such key.
static bool equal(const json_t *a, const json_t *b, const char *key) {
  const json_t *x = json_object_get(a, key), *y = json_object_get(b, key);
  return json_equal(x, y) || (!x && !y);
}

// Options of an engine but for the path of a file, which differs from one checkout to the next.
static bool same_options(const json_t *a, const json_t *b) {
  json_t *x = json_copy(json_object_get(a, "options")),
         *y = json_copy(json_object_get(b, "options"));
  if (x) json_object_del(x, "file");
  if (y) json_object_del(y, "file");
  bool same = json_equal(x, y) || (!x && !y);
  json_decref(x);
  json_decref(y);
  return same;
}

// The first key in which two entries differ that decides whether they can be compared; NULL if
// they can. Derived numbers of the setup (its growth rate) may differ by a rounding.
static const char *first_difference(const json_t *a, const json_t *b) {
  static const char *const setup[] = {"start", "duration", "sample", "instants", "input"};
  static const char *const roles[] = {"reference", "candidate"};
  static const char *const engine_keys[] = {"engine", "version"};
  if (!equal(a, b, "parameter_sha256")) return "parameter_sha256";
  for (size_t i = 0; i < sizeof setup / sizeof *setup; i++)
    if (!equal(json_object_get(a, "setup"), json_object_get(b, "setup"), setup[i])) return setup[i];
  for (int i = 0; i < 2; i++) {
    const json_t *x = report_engine(a, roles[i]), *y = report_engine(b, roles[i]);
    for (int k = 0; k < 2; k++)
      if (!equal(x, y, engine_keys[k])) return engine_keys[k];
    if (!same_options(x, y)) return "options";
  }
  return NULL;
}

term_exit baseline_match(const json_t *document, const json_t *baseline, problem *p) {
  size_t i;
  const json_t *entry;
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    const char *name = report_text(entry, "name");
    const json_t *before = entry_named(baseline, name);
    if (!before) return problem_set(p, TERM_BASELINE, "the baseline has no scenario '%s'", name);
    const char *key = first_difference(entry, before);
    if (key)
      return problem_set(p, TERM_BASELINE, "the baseline's '%s' is another ride: %s differs", name,
                         key);
  }
  return TERM_DONE;
}

// The gate of the same name in another entry; NULL if there is none.
static json_t *gate_like(const json_t *entry, const report_gate *g) {
  size_t i;
  json_t *other;
  json_array_foreach(json_object_get(entry, "gates"), i, other) {
    report_gate o = report_gate_at(entry, i);
    if (strcmp(o.layer, g->layer) == 0 && strcmp(o.signal, g->signal) == 0 &&
        strcmp(o.metric, g->metric) == 0 && o.from == g->from && o.to == g->to)
      return other;
  }
  return NULL;
}

static const char *change_of(double before, double now, double floor) {
  if (isnan(before) && isnan(now)) return "same";
  if (isnan(now)) return "worse";
  if (isnan(before)) return "better";
  if (fabs(now - before) <= floor) return "same";
  return now > before ? "worse" : "better";
}

static bool compare_gate(json_t *entry, size_t index, const json_t *before) {
  report_gate g = report_gate_at(entry, index);
  json_t *judged = json_array_get(json_object_get(entry, "gates"), index);
  const json_t *old = gate_like(before, &g);
  if (!old)
    return json_object_set_new(judged, "baseline",
                               json_pack("{s:n, s:n, s:s, s:s}", "value", "floor", "floor_source",
                                         "none", "change", "new")) == 0;
  double value = report_real(old, "value");
  const char *source;
  if (json_object_set_new(judged, "baseline", json_pack("{s:o}", "value", term_json_number(value))))
    return false;
  double floor = baseline_floor(&source, entry, index);
  json_t *block = json_object_get(judged, "baseline");
  return json_object_set_new(block, "floor", term_json_number(floor)) == 0 &&
         json_object_set_new(block, "floor_source", json_string(source)) == 0 &&
         json_object_set_new(block, "change", json_string(change_of(value, g.value, floor))) == 0;
}

// Names of gates that the baseline has and the entry has not: what is no longer measured.
static json_t *gone_gates(const json_t *entry, const json_t *before) {
  json_t *gone = json_array();
  for (size_t i = 0; i < report_count(before, "gates"); i++) {
    report_gate g = report_gate_at(before, i);
    if (!gate_like(entry, &g))
      json_array_append_new(gone, json_sprintf("%s %s %s", g.layer, g.signal, g.metric_words));
  }
  return gone;
}

static const char *const changes[] = {"better", "same", "worse", "new"};
enum { CHANGES = sizeof changes / sizeof *changes };

static bool compare_entry(json_t *entry, const json_t *before, size_t total[CHANGES],
                          size_t *gone_total) {
  for (size_t i = 0; i < report_count(entry, "gates"); i++)
    if (!compare_gate(entry, i, before)) return false;
  json_t *gone = gone_gates(entry, before), *block = json_object();
  for (int i = 0; i < CHANGES; i++) {
    size_t count = report_changed_gates(entry, changes[i]);
    json_object_set_new(block, changes[i], json_integer((json_int_t)count));
    total[i] += count;
  }
  *gone_total += json_array_size(gone);
  return json_object_set_new(block, "gone", gone) == 0 &&
         json_object_set_new(entry, "baseline", block) == 0;
}

bool baseline_compare(json_t *document, const json_t *baseline) {
  size_t i, total[CHANGES] = {0}, gone = 0;
  json_t *entry;
  const json_t *origin = json_object_get(baseline, "provenance");
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    const json_t *before = entry_named(baseline, report_text(entry, "name"));
    if (!compare_entry(entry, before, total, &gone)) return false;
  }
  json_t *block =
      json_pack("{s:s, s:s, s:s}", "created", report_text(origin, "created"), "project",
                report_text(origin, "project"), "compiler", report_text(origin, "compiler"));
  for (int k = 0; k < CHANGES; k++)
    json_object_set_new(block, changes[k], json_integer((json_int_t)total[k]));
  json_object_set_new(block, "gone", json_integer((json_int_t)gone));
  return json_object_set_new(document, "baseline", block) == 0;
}

bool baseline_is_worse(const json_t *document) {
  const json_t *block = json_object_get(document, "baseline");
  return report_real(block, "worse") > 0 || report_real(block, "gone") > 0;
}
