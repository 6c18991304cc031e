// SPDX-License-Identifier: Apache-2.0
// The parts of report.html, one file that needs no network and is read with scripts or without.
#ifndef VALIDATE_REPORT_HTML_H
#define VALIDATE_REPORT_HTML_H

#include "report_views.h"

// The limits' reasons, each once, in the order in which gates name them.
typedef struct report_reasons {
  const char **items; // of the document
  size_t count;
} report_reasons;

// Written in this order; false when out of memory.
void report_html_verdict(FILE *stream, const json_t *document);
void report_html_overview(FILE *stream, const json_t *document);
bool report_html_scenario(FILE *stream, const comparison *c, const json_t *entry,
                          report_reasons *reasons);
bool report_html_gates(FILE *stream, const json_t *entry, report_reasons *reasons);
void report_html_reasons(FILE *stream, const report_reasons *reasons);
void report_html_provenance(FILE *stream, const json_t *document);

#endif
