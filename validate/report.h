// SPDX-License-Identifier: Apache-2.0
// What the comparator shows. report.json is the source: everything else is a view of the same.
#ifndef VALIDATE_REPORT_H
#define VALIDATE_REPORT_H

#include "comparison.h"
#include "provenance.h"

#include <jansson.h>
#include <stdio.h>

#define REPORT_SCHEMA "bicycle-validate-report"
enum { REPORT_VERSION = 2 }; // of the schema; earlier ones can be read

typedef struct report {
  const comparison *comparisons;
  size_t count;
  provenance provenance;
} report;

// The worst verdict of all scenarios: VERDICT_DIFFER only where none agrees.
verdict report_verdict(const report *r);

// The first comparison with that verdict; NULL if no limit fails.
const comparison *report_first_failure(const report *r);

// The document report.json; NULL when out of memory.
json_t *report_document(const report *r);

// Verdict, then a table of gates for each scenario, worst first: all of them, or those that fail
// and the few that are closest to their limit, with what the baseline says of them.
void report_print(const json_t *document, bool all, FILE *stream);

// Every row of a trace: the columns of `bicycle ride`, then work, forces, and where it has them
// slip and height.
void report_trace_csv(const trace *t, FILE *stream);

// Candidate minus reference for every column that both have.
void report_residual_csv(const comparison *c, FILE *stream);

enum { REPORT_FILES_PER_SCENARIO = 3, REPORT_FILE_NAME = 128 };

// Names of a scenario's files within the report.
void report_file_names(char out[REPORT_FILES_PER_SCENARIO][REPORT_FILE_NAME], const comparison *c);

// The views of the whole report, by number: "report.json", "report.html", ...
enum { REPORT_VIEWS = 4 };
const char *report_view_name(int index);

// Writes the report into a folder: whole, or not at all. `document` is its report.json.
term_exit report_write(const report *r, const json_t *document, const char *folder, problem *p);

#endif
