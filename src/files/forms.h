// SPDX-License-Identifier: Apache-2.0
// The YAML forms of a bicycle file, each read from a parsed document.
#ifndef FILES_FORMS_H
#define FILES_FORMS_H

#include "components.h"
#include "meijaard.h"
#include "yaml.h"

// Meijaard's symbols under `values:` (the file names its parameterization) or at the root. `name`
// receives the text of `parameters:`, empty where it has none.
int bike_read_values_form(bike_symbols *out, char name[BIKE_NAME_SIZE], const bike_yaml *yaml);
int bike_read_flat_form(bike_symbols *out, char name[BIKE_NAME_SIZE], const bike_yaml *yaml);

// `parameterization: components`, checked whole, and what the file says number by number. The
// bicycle's name is empty where none is given.
int bike_read_components(bike_bicycle *out, bike_description *description, const bike_yaml *yaml);

#endif
