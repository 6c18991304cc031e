// SPDX-License-Identifier: Apache-2.0
// A bicycle file as it was read, before it became a bicycle.
#ifndef FILES_SOURCE_H
#define FILES_SOURCE_H

#include "components.h"
#include "meijaard.h"

typedef struct bike_source {
  bool literature;              // which of the two it is
  bike_symbols symbols;         // Meijaard's, from any of the three forms that use them
  bike_description description; // `parameterization: components`
} bike_source;

// bike_file_read, which also keeps what the file says. `source` is large: 16 KiB.
int bike_source_read(bike_file *out, bike_source *source, const char *path, bike_file_error *error);

#endif
