// SPDX-License-Identifier: Apache-2.0
#include "report_counts.h"

#include "comparison.h"
#include "report_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Notes a gate under its layer and signal: [text, failed], the text being the first value that is
// not zero, empty while all are.
static bool note_gate(json_t *quantities, const report_gate *g) {
  char *key = NULL, value[MEASUREMENT_METRIC + 40] = "";
  if (asprintf(&key, "%s %s", g->layer, g->signal) < 0) return false;
  if (g->value != 0) snprintf(value, sizeof value, "%s %.17g", g->metric_words, g->value);
  json_t *known = json_object_get(quantities, key);
  const char *before = known ? json_string_value(json_array_get(known, 0)) : "";
  bool failed = !g->pass || json_is_true(json_array_get(known, 1));
  json_t *noted = json_pack("[s, b]", *before ? before : value, failed);
  bool done = json_object_set_new(quantities, key, noted) == 0;
  free(key);
  return done;
}

// The quantities of a scenario that no earlier one has; `seen` holds those of all.
static bool count_new(json_t *seen, const char *bicycle, const json_t *quantities, size_t *all,
                      size_t *failed) {
  const char *name;
  json_t *quantity;
  json_object_foreach((json_t *)quantities, name, quantity) {
    const char *value = json_string_value(json_array_get(quantity, 0));
    char *key = NULL;
    if (!*value) continue;
    if (asprintf(&key, "%s %s %s", bicycle, name, value) < 0) return false;
    bool fresh = !json_object_get(seen, key);
    bool done = !fresh || json_object_set_new(seen, key, json_true()) == 0;
    free(key);
    if (!done) return false;
    *all += fresh;
    *failed += fresh && json_is_true(json_array_get(quantity, 1));
  }
  return true;
}

static bool count_scenario(json_t *seen, const json_t *entry, size_t *all, size_t *failed) {
  json_t *quantities = json_object();
  bool done = quantities;
  for (size_t i = 0; done && i < report_count(entry, "gates"); i++) {
    report_gate g = report_gate_at(entry, i);
    done = note_gate(quantities, &g);
  }
  done = done && count_new(seen, report_text(entry, "parameter_sha256"), quantities, all, failed);
  json_decref(quantities);
  return done;
}

json_t *report_counts(const json_t *scenarios) {
  size_t verdicts[VERDICT_INVALID + 1] = {0}, gates = 0, all = 0, failed = 0, i;
  const json_t *entry;
  json_t *seen = json_object();
  bool done = seen;
  json_array_foreach(scenarios, i, entry) {
    for (int v = VERDICT_AGREE; v <= VERDICT_INVALID; v++)
      verdicts[v] += strcmp(report_text(entry, "verdict"), verdict_string((verdict)v)) == 0;
    gates += report_count(entry, "gates");
    done = done && count_scenario(seen, entry, &all, &failed);
  }
  json_decref(seen);
  if (!done) return NULL;
  return json_pack("{s:I, s:I, s:I, s:I, s:I, s:I, s:I}", "agree",
                   (json_int_t)verdicts[VERDICT_AGREE], "differ",
                   (json_int_t)verdicts[VERDICT_DIFFER], "fail", (json_int_t)verdicts[VERDICT_FAIL],
                   "invalid", (json_int_t)verdicts[VERDICT_INVALID], "gates", (json_int_t)gates,
                   "measurements", (json_int_t)all, "failed", (json_int_t)failed);
}
