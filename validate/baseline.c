// SPDX-License-Identifier: Apache-2.0
#include "baseline.h"

#include "report_read.h"
#include "terminal/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The scenarios of a report by their names; NULL when out of memory.
static json_t *scenarios_by_name(const json_t *document) {
  size_t i;
  json_t *entry, *index = json_object();
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    if (json_object_set(index, report_text(entry, "name"), entry)) {
      json_decref(index);
      return NULL;
    }
  }
  return index;
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

static term_exit match(const json_t *document, const json_t *index, problem *p) {
  size_t i;
  const json_t *entry;
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    const char *name = report_text(entry, "name");
    const json_t *before = json_object_get(index, name);
    if (!before) return problem_set(p, TERM_BASELINE, "the baseline has no scenario '%s'", name);
    const char *key = first_difference(entry, before);
    if (key)
      return problem_set(p, TERM_BASELINE, "the baseline's '%s' is another ride: %s differs", name,
                         key);
  }
  return TERM_DONE;
}

term_exit baseline_match(const json_t *document, const json_t *baseline, problem *p) {
  json_t *index = scenarios_by_name(baseline);
  term_exit code = index ? match(document, index, p) : problem_memory(p);
  json_decref(index);
  return code;
}

//---------------------------------- gates ---------------------------------------------------------

// What makes a gate the same in two reports, as one text; NULL when out of memory.
static char *gate_key(const report_gate *g) {
  char *key;
  int size =
      asprintf(&key, "%s\n%s\n%s\n%.17g\n%.17g", g->layer, g->signal, g->metric, g->from, g->to);
  return size < 0 ? NULL : key;
}

// The gates of a scenario by their keys, the first of each; NULL when out of memory.
static json_t *gates_by_key(const json_t *entry) {
  json_t *index = json_object(), *gates = json_object_get(entry, "gates");
  bool done = index;
  for (size_t i = 0; done && i < json_array_size(gates); i++) {
    report_gate g = report_gate_at(entry, i);
    char *key = gate_key(&g);
    done = key && (json_object_get(index, key) ||
                   json_object_set(index, key, json_array_get(gates, i)) == 0);
    free(key);
  }
  if (done) return index;
  json_decref(index);
  return NULL;
}

static const char *change_of(double before, double now, double floor) {
  if (isnan(before) && isnan(now)) return "same";
  if (isnan(now)) return "worse";
  if (isnan(before)) return "better";
  if (fabs(now - before) <= floor) return "same";
  return now > before ? "worse" : "better";
}

static bool compare_gate(json_t *entry, size_t index, const json_t *gates_before) {
  report_gate g = report_gate_at(entry, index);
  json_t *judged = json_array_get(json_object_get(entry, "gates"), index);
  char *key = gate_key(&g);
  if (!key) return false;
  const json_t *old = json_object_get(gates_before, key);
  free(key);
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

// Names of gates that the baseline has and the entry has not: what is no longer measured. NULL when
// out of memory.
static json_t *gone_gates(const json_t *gates_now, const json_t *before) {
  json_t *gone = json_array();
  for (size_t i = 0; i < report_count(before, "gates"); i++) {
    report_gate g = report_gate_at(before, i);
    char *key = gate_key(&g);
    bool done = key && (json_object_get(gates_now, key) ||
                        json_array_append_new(gone, json_sprintf("%s %s %s", g.layer, g.signal,
                                                                 g.metric_words)) == 0);
    free(key);
    if (done) continue;
    json_decref(gone);
    return NULL;
  }
  return gone;
}

static const char *const changes[] = {"better", "same", "worse", "new"};
enum { CHANGES = sizeof changes / sizeof *changes };

// What a document counts of all its scenarios.
typedef struct totals {
  size_t changed[CHANGES], gone;
} totals;

static bool compare_gates(json_t *entry, const json_t *before) {
  json_t *gates_before = gates_by_key(before);
  bool done = gates_before;
  for (size_t i = 0; done && i < report_count(entry, "gates"); i++)
    done = compare_gate(entry, i, gates_before);
  json_decref(gates_before);
  return done;
}

static bool compare_entry(json_t *entry, const json_t *before, totals *t) {
  if (!compare_gates(entry, before)) return false;
  json_t *gates_now = gates_by_key(entry);
  json_t *gone = gates_now ? gone_gates(gates_now, before) : NULL, *block = json_object();
  json_decref(gates_now);
  for (int i = 0; i < CHANGES; i++) {
    size_t count = report_changed_gates(entry, changes[i]);
    json_object_set_new(block, changes[i], json_integer((json_int_t)count));
    t->changed[i] += count;
  }
  t->gone += json_array_size(gone);
  if (json_object_set_new(block, "gone", gone) == 0)
    return json_object_set_new(entry, "baseline", block) == 0;
  json_decref(block);
  return false;
}

//---------------------------------- documents -----------------------------------------------------

// Names of scenarios that the baseline has and the document has not. NULL when out of memory.
static json_t *missing_scenarios(const json_t *document, const json_t *baseline) {
  size_t i;
  const json_t *entry;
  json_t *index = scenarios_by_name(document), *missing = index ? json_array() : NULL;
  json_array_foreach(json_object_get(baseline, "scenarios"), i, entry) {
    json_t *name = json_object_get(entry, "name");
    if (!missing || json_object_get(index, json_string_value(name))) continue;
    if (json_array_append(missing, name) == 0) continue;
    json_decref(missing);
    missing = NULL;
  }
  json_decref(index);
  return missing;
}

static bool compare_entries(json_t *document, const json_t *baseline, totals *t) {
  size_t i;
  json_t *entry, *index = scenarios_by_name(baseline);
  bool done = index;
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    done = done && compare_entry(entry, json_object_get(index, report_text(entry, "name")), t);
  }
  json_decref(index);
  return done;
}

bool baseline_compare(json_t *document, const json_t *baseline) {
  totals t = {0};
  const json_t *origin = json_object_get(baseline, "provenance");
  if (!compare_entries(document, baseline, &t)) return false;
  json_t *block =
      json_pack("{s:s, s:s, s:s}", "created", report_text(origin, "created"), "project",
                report_text(origin, "project"), "compiler", report_text(origin, "compiler"));
  for (int k = 0; k < CHANGES; k++)
    json_object_set_new(block, changes[k], json_integer((json_int_t)t.changed[k]));
  json_object_set_new(block, "gone", json_integer((json_int_t)t.gone));
  if (json_object_set_new(block, "missing", missing_scenarios(document, baseline)) == 0)
    return json_object_set_new(document, "baseline", block) == 0;
  json_decref(block);
  return false;
}

bool baseline_is_worse(const json_t *document) {
  const json_t *block = json_object_get(document, "baseline");
  return report_real(block, "worse") > 0 || report_real(block, "gone") > 0 ||
         report_count(block, "missing") > 0;
}
