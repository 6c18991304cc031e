// SPDX-License-Identifier: Apache-2.0
// A working folder of a test's own: other tests leave MuJoCo's log in the common one.
#ifndef BICYCLE_TESTS_OWN_FOLDER_H
#define BICYCLE_TESTS_OWN_FOLDER_H

#include <stdlib.h>
#include <unistd.h>

typedef struct own_folder {
  char name[24];
} own_folder;

static inline own_folder enter_own_folder(void) {
  own_folder folder = {"own_folder_XXXXXX"};
  if (!mkdtemp(folder.name) || chdir(folder.name) != 0) abort();
  return folder;
}

// Removes the folder if the test has left nothing in it.
static inline void leave_own_folder(const own_folder *folder) {
  if (chdir("..") == 0) rmdir(folder->name);
}

#endif
