// SPDX-License-Identifier: Apache-2.0
// Numbers of tests/reference/published.json by their path.
#ifndef BICYCLE_TESTS_REFERENCE_H
#define BICYCLE_TESTS_REFERENCE_H

#include <jansson.h>

// The whole document; fails the running test where the file cannot be read. Free with json_decref.
json_t *reference_open(void);

// The number at a dotted path, as in "basu_mandal2007_table1.qdd.x" or "meijaard2007.M.0.1"; fails
// the running test where there is none.
double reference_number(const json_t *document, const char *path);

#endif
