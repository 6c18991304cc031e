// SPDX-License-Identifier: Apache-2.0
// Baselines: a report held against an earlier one, metric by metric.
//
// A metric is better or worse if it differs by more than its noise floor, the same otherwise. All
// gated metrics are errors: smaller is better. What has no limit is not judged, nor is any timing.
#ifndef VALIDATE_BASELINE_H
#define VALIDATE_BASELINE_H

#include "problem.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

// Reads a saved report, a file or a report's folder; json_decref it. TERM_BASELINE with one line
// where it is missing, is not a report, is damaged, or is one of another version of the schema;
// TERM_USAGE for a named pipe.
term_exit baseline_read(json_t **out, const char *path, problem *p);

// Whether every scenario of `document` has its like in the baseline: same name, bicycle, start,
// times and engines with their options and versions. TERM_BASELINE with the first difference.
term_exit baseline_match(const json_t *document, const json_t *baseline, problem *p);

// Adds to each gate {value, floor, floor_source, change} as "baseline", to each scenario and to the
// document the counts, the gates that are gone and the scenarios that are missing. The two must
// match. In time n log n. False when out of memory.
bool baseline_compare(json_t *document, const json_t *baseline);

// Whether anything is worse, or a gate or a scenario of the baseline is gone.
bool baseline_is_worse(const json_t *document);

// Prints the counts and every metric that changed, worse ones first, or why the document could not
// be compared; nothing if that was not asked for.
void baseline_print(const json_t *document, FILE *stream);

// How much a value may differ for reasons that mean nothing: `index` is of a gate of a scenario.
// `source` says in words where the floor comes from.
double baseline_floor(const char **source, const json_t *entry, size_t index);

#endif
