// SPDX-License-Identifier: Apache-2.0
// The views of a report, each one file. `document` is its report.json.
#ifndef VALIDATE_REPORT_VIEWS_H
#define VALIDATE_REPORT_VIEWS_H

#include "report.h"

// Writes a view; false when out of memory. What goes wrong with the stream is found by who closes
// it.
typedef bool report_view(const report *r, const json_t *document, FILE *stream);

report_view report_html, report_junit, report_summary;

#endif
