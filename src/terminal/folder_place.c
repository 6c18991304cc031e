// SPDX-License-Identifier: Apache-2.0
#include "terminal/folder_place.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

char *term_place_of(const char *path) {
  char *real = realpath(path, NULL);
  if (real) return real;
  char *copy = strdup(path);
  size_t length = copy ? strlen(copy) : 0;
  while (length > 1 && copy[length - 1] == '/') copy[--length] = '\0';
  return copy;
}

char *term_place_aside(const char *place, const char *kind) {
  const char *slash = strrchr(place, '/');
  int parent = slash ? (int)(slash - place) + 1 : 0;
  char *path = NULL;
  if (asprintf(&path, "%.*s.%s.%ld.%s", parent, place, place + parent, (long)getpid(), kind) < 0)
    return NULL;
  return path;
}

char *term_place_parent(const char *place) {
  char *copy = strdup(place);
  char *parent = copy ? strdup(dirname(copy)) : NULL; // dirname may answer with a constant
  free(copy);
  return parent;
}

int term_place_check_parent(const char *parent) {
  struct stat status;
  if (stat(parent, &status) != 0) return errno;
  if (!S_ISDIR(status.st_mode)) return ENOTDIR;
  return access(parent, W_OK | X_OK) != 0 ? errno : 0;
}

// Where the file system cannot exchange two folders at once: out of the way, and back if the new
// one cannot take its place.
static int take_in_two(const char *aside, const char *place, term_place_remove *remove,
                       const void *user) {
  char *old = term_place_aside(place, "old");
  if (!old) return ENOMEM;
  int number = rename(place, old) == 0 ? 0 : errno;
  if (!number && rename(aside, place) != 0) {
    number = errno;
    rename(old, place);
  } else if (!number) {
    remove(old, user);
  }
  free(old);
  return number;
}

int term_place_take(const char *aside, const char *place, term_place_remove *remove,
                    const void *user) {
  // Onto an empty folder, or where there is none, a plain rename does.
  if (rename(aside, place) == 0) return 0;
  if (errno != ENOTEMPTY && errno != EEXIST) return errno;
  if (renameat2(AT_FDCWD, aside, AT_FDCWD, place, RENAME_EXCHANGE) != 0)
    return take_in_two(aside, place, remove, user);
  remove(aside, user);
  return 0;
}
