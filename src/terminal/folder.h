// SPDX-License-Identifier: Apache-2.0
// A folder of files that appears whole or not at all.
#ifndef BICYCLE_TERMINAL_FOLDER_H
#define BICYCLE_TERMINAL_FOLDER_H

#include "terminal/exit_code.h"

#include <stddef.h>

typedef struct term_file {
  const char *name;  // without a slash
  const void *bytes; // NULL: not to be written, but one that is there may go
  size_t size;       //
} term_file;

// Whether the folder could be written: it is not there yet, or is empty, or holds files of these
// names and nothing else, and its parent takes new entries. Reports what is wrong: TERM_USAGE.
term_exit term_folder_check(const char *path, const term_file *files, int count);

// The same, and writes it: the files are written into a folder beside it, which then takes its name
// and its place. TERM_USAGE, and nothing has changed, where that fails. A signal that would end the
// program meanwhile waits until the folder is whole or gone.
term_exit term_folder_write(const char *path, const term_file *files, int count);

#endif
