// SPDX-License-Identifier: Apache-2.0
// A folder of its own for a test's files.
#ifndef TESTS_FILES_SCRATCH_H
#define TESTS_FILES_SCRATCH_H

#include <stdbool.h>
#include <stddef.h>

enum { SCRATCH_PATH_SIZE = 256 };

// cmocka's group set-up and tear-down: makes the folder, removes it with all it holds.
int scratch_create(void **state);
int scratch_remove(void **state);

// "FOLDER/name", valid until the next call.
const char *scratch_path(const char *name);
const char *scratch_folder(void);

// Writes a file and returns its path, valid until the next call.
const char *scratch_write(const char *name, const char *text);
const char *scratch_write_bytes(const char *name, const void *bytes, size_t size);

// The whole of a file, terminated, to be freed; fails the test where it cannot be read.
char *scratch_read(const char *path);

// Root reads and writes everything: makes the test an ordinary user until scratch_be_self, one who
// may or may not add to the folder.
void scratch_be_nobody(bool may_add);
void scratch_be_self(void);

// How many entries the folder has.
int scratch_count(void);

#endif
