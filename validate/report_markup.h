// SPDX-License-Identifier: Apache-2.0
// Text and numbers for HTML, SVG, XML and Markdown.
#ifndef VALIDATE_REPORT_MARKUP_H
#define VALIDATE_REPORT_MARKUP_H

#include <stddef.h>
#include <stdio.h>

// Text for an element or a quoted attribute; what XML 1.0 cannot hold becomes U+FFFD.
void report_escape(FILE *stream, const char *text);

// Text as one segment of a URL, or as its fragment: all but the unreserved characters of RFC 3986
// is percent-encoded.
void report_url(FILE *stream, const char *text);

// Within printf: each %s of `format` is escaped, each %u written as report_url does, %% is a per
// cent sign, nothing else is allowed. The arguments are const char *.
void report_markup(FILE *stream, const char *format, ...);

enum { REPORT_NUMBER = 48 };

// Three digits: "3.01e-13", "10"; "-" where there is no number.
const char *report_number(char out[REPORT_NUMBER], double value);

// The same with its unit: "10 s".
const char *report_quantity(char out[REPORT_NUMBER], double value, const char *unit);

// How many times the value fits into its limit, from the use of it: "33.2x", "exact", "-".
const char *report_margin(char out[REPORT_NUMBER], double use);

// Base64 (RFC 4648) of bytes, without line feeds.
void report_base64(FILE *stream, const unsigned char *bytes, size_t size);

#endif
