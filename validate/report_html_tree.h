// SPDX-License-Identifier: Apache-2.0
#ifndef VALIDATE_REPORT_HTML_TREE_H
#define VALIDATE_REPORT_HTML_TREE_H

#include <jansson.h>
#include <stdio.h>

// Shows any value: objects as lists of keys, arrays of objects as tables.
void report_html_tree(FILE *stream, const json_t *value);

#endif
