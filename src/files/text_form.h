// SPDX-License-Identifier: Apache-2.0
// BicycleParameters' text form: `name = value` or `name = value+/-uncertainty`, one a line.
#ifndef FILES_TEXT_FORM_H
#define FILES_TEXT_FORM_H

#include "meijaard.h"
#include "text.h"

// Whether the first line that says something is of this form: an equals sign before any colon.
bool bike_is_text_form(const bike_text *text);

// Reads the symbols. An uncertainty may bind its value with brackets and a common power of ten, as
// in (1.20+/-0.10)e-05. BIKE_ERROR_SYNTAX with the line in the message.
int bike_read_text_form(bike_symbols *out, const bike_text *text, const char *path,
                        bike_file_error *error);

#endif
