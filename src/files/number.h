// SPDX-License-Identifier: Apache-2.0
// Decimal numbers in and out, whatever the locale of the program.
#ifndef FILES_NUMBER_H
#define FILES_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

enum { BIKE_NUMBER_SIZE = 32 }; // "-1.7976931348623157e+308" and a terminator fit

// Reads a number: sign, decimal digits with at most one point, exponent; nothing else, so neither
// hexadecimal nor underscores nor surrounding blanks. Of any length, rounded correctly. Returns
// NULL, or what is wrong with the text ("is not a number", "is not finite", "is too large").
const char *bike_number_parse(double *out, const char *text, size_t length);

// Whether the text is one of the usual spellings of NaN or infinity; `out` is then that.
bool bike_number_is_not_finite(double *out, const char *text, size_t length);

// Writes a finite number with 17 significant digits, the fewest that give every double back.
void bike_number_print(char out[BIKE_NUMBER_SIZE], double value);

// The same with a decimal point in any case: YAML 1.1 reads 1e-05 and 5 as something else than a
// floating-point number.
void bike_number_print_point(char out[BIKE_NUMBER_SIZE], double value);

#endif
