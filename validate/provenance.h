// SPDX-License-Identifier: Apache-2.0
// Where a report comes from: what someone else needs to get the same figures.
#ifndef VALIDATE_PROVENANCE_H
#define VALIDATE_PROVENANCE_H

#include "files/sha256.h"

#include <bicycle/bicycle.h>

enum { PROVENANCE_TEXT = 256, PROVENANCE_TIME = 32 };

typedef struct provenance {
  char *command;                 // the command line that repeats the run; allocated
  char cpu[PROVENANCE_TEXT];     //
  char created[PROVENANCE_TIME]; // UTC, ISO 8601
  double elapsed;                // s  of the whole run
} provenance;

// `arguments` are the scenarios as given. False when out of memory; clear it in any case.
bool provenance_begin(provenance *out, char *const *arguments, int count);
void provenance_clear(provenance *out);

// Compiler and kind of build, as in "gcc 12.2.0, Release".
const char *provenance_compiler(void);

// Hash of every number of a bicycle; names do not count.
bool provenance_bicycle_hash(char out[SHA256_HEX_SIZE], const bike_bicycle *bicycle);

#endif
