// SPDX-License-Identifier: Apache-2.0
// The rows of validate/REPRODUCTION.md: | `key` | place | claim | our figure | verdict | command |
//
// Figures are the bold numbers of a row, in order. A figure is written with the digits that it
// stands with, **4.953** or **2.1e-10**; **none** is a speed that does not exist; **< 1e-12** is a
// limit, for what is rounding and differs between machines.
#ifndef BICYCLE_TESTS_REPRODUCTION_DOCUMENT_H
#define BICYCLE_TESTS_REPRODUCTION_DOCUMENT_H

#include "claims.h"
#include <stdbool.h>
#include <stddef.h>

enum { KEY_SIZE = 40, VERDICTS = 3 };
extern const char *const verdicts[VERDICTS]; // confirmed, partly, not

// The key of a row of the table into `key`; false for any other line.
bool document_key(char key[KEY_SIZE], const char *line);

// Index of the row's verdict, which ", by construction" may follow; -1 where it is none of the
// three.
int document_verdict(const char *line);

// Whether a choice of ours decides the row's verdict: ", by construction" follows it.
bool document_is_constructed(const char *line);

// Holds the figures of a line against computed ones and prints what differs; the number of faults.
int document_check(const char *key, const char *line, const figures *computed);

// The line with its figures renewed into `out`.
void document_renew(char *out, size_t size, const char *line, const figures *computed);

#endif
