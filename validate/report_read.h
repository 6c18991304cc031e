// SPDX-License-Identifier: Apache-2.0
// The document report.json as its views read it: a saved report or one just made, there is no
// difference.
#ifndef VALIDATE_REPORT_READ_H
#define VALIDATE_REPORT_READ_H

#include "measurement.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

// A gate of a scenario. Texts belong to the document and are never NULL.
typedef struct report_gate {
  const char *layer, *signal, *metric, *unit, *detail, *reason;
  char metric_words[MEASUREMENT_METRIC]; // with its part of the ride: "max (1 to 3 s)"
  double value, limit;                   // NaN for null
  double time;                           // s  NaN without
  double from, to;                       // s  the part of the ride; 0: to its end
  bool pass;
  const char *change; // "better", "same", "worse" than the baseline; "" without one
  double before;      // the baseline's value; NaN without
  size_t index;       // within the scenario
} report_gate;

// The metric of a gate or a measurement with its part of the ride, as in report_gate.
const char *report_metric(char out[MEASUREMENT_METRIC], const json_t *measured);

// Empty text, NaN for what is missing or of another type.
const char *report_text(const json_t *object, const char *key);
double report_real(const json_t *object, const char *key);

// Number of items of an array, 0 for anything else.
size_t report_count(const json_t *object, const char *key);

report_gate report_gate_at(const json_t *entry, size_t index);

// Value over limit: 0 for a value of zero, infinite for NaN and beyond a limit of zero.
double report_gate_use(const report_gate *g);

// All gates of a scenario, failures first, then by falling use; free it. NULL when out of memory.
report_gate *report_gates_by_margin(const json_t *entry, size_t *count);

size_t report_failed_gates(const json_t *entry);

// How many gates of a scenario changed in that way against the baseline.
size_t report_changed_gates(const json_t *entry, const char *change);

// Whether the verdict of a document or scenario is "agree" or "differs as expected".
bool report_passed(const json_t *object);

// The verdict as a title: "Differs as expected".
const char *report_verdict_title(const json_t *object);

// The first scenario that has the document's verdict; NULL where no limit fails.
const json_t *report_first_failing(const json_t *document);

// ", but worse than the baseline", ", but not compared with the baseline", or "": what the verdict
// of a document does not say.
const char *report_baseline_words(const json_t *document);

// The engine of a scenario that plays a role: "reference", "candidate"; NULL if there is none.
const json_t *report_engine(const json_t *entry, const char *role);

enum { REPORT_COUNTS_TEXT = 200 };

// "23 scenarios agree, 2 differ as expected; 556 independent measurements within their limits": the
// `counts` of a document (report_counts.h).
const char *report_describe_counts(char out[REPORT_COUNTS_TEXT], const json_t *document);

#endif
