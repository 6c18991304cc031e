// SPDX-License-Identifier: Apache-2.0
#include "terminal/folder.h"

#include "terminal/message.h"

#include <bicycle/error.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static term_exit fail(const char *path, int number) {
  return term_fail(TERM_USAGE, "%s: %s", path, strerror(number));
}

// The path without slashes at its end, symbolic links followed; NULL without memory.
static char *plain_path(const char *path) {
  char *real = realpath(path, NULL);
  if (real) return real;
  char *copy = strdup(path);
  size_t length = copy ? strlen(copy) : 0;
  while (length > 1 && copy[length - 1] == '/') copy[--length] = '\0';
  return copy;
}

//---------------------------------- what is there already -----------------------------------------

static bool is_ours(const char *name, const term_file *files, int count) {
  for (int i = 0; i < count; i++)
    if (strcmp(name, files[i].name) == 0) return true;
  return strcmp(name, ".") == 0 || strcmp(name, "..") == 0;
}

// A folder that bears the name of a file is somebody else's.
static bool is_folder(DIR *parent, const char *name) {
  struct stat status;
  return fstatat(dirfd(parent), name, &status, AT_SYMLINK_NOFOLLOW) == 0 &&
         S_ISDIR(status.st_mode) && strcmp(name, ".") != 0 && strcmp(name, "..") != 0;
}

static term_exit check_content(const char *path, const term_file *files, int count) {
  DIR *folder = opendir(path);
  if (!folder) return fail(path, errno);
  term_exit code = TERM_DONE;
  for (struct dirent *entry = readdir(folder); entry && code == TERM_DONE; entry = readdir(folder))
    if (!is_ours(entry->d_name, files, count) || is_folder(folder, entry->d_name))
      code =
          term_fail(TERM_USAGE, "%s: not replaced, since it also holds '%s'", path, entry->d_name);
  closedir(folder);
  return code;
}

static term_exit check_parent(const char *target) {
  char *copy = strdup(target);
  if (!copy) return term_fail_bike(BIKE_ERROR_MEMORY, target);
  const char *parent = dirname(copy);
  struct stat status;
  int number = stat(parent, &status) != 0         ? errno
               : !S_ISDIR(status.st_mode)         ? ENOTDIR
               : access(parent, W_OK | X_OK) != 0 ? errno
                                                  : 0;
  term_exit code = number ? fail(parent, number) : TERM_DONE;
  free(copy);
  return code;
}

static term_exit check(const char *target, const term_file *files, int count) {
  struct stat status;
  term_exit code = TERM_DONE;
  if (stat(target, &status) == 0)
    code = S_ISDIR(status.st_mode) ? check_content(target, files, count) : fail(target, ENOTDIR);
  else if (errno != ENOENT)
    code = fail(target, errno);
  return code == TERM_DONE ? check_parent(target) : code;
}

term_exit term_folder_check(const char *path, const term_file *files, int count) {
  char *target = plain_path(path);
  term_exit code = target ? check(target, files, count) : term_fail_bike(BIKE_ERROR_MEMORY, path);
  free(target);
  return code;
}

//---------------------------------- writing -------------------------------------------------------

// "PARENT/.NAME.PID.tmp"; NULL without memory.
static char *path_aside(const char *target, const char *kind) {
  const char *slash = strrchr(target, '/');
  int parent = slash ? (int)(slash - target) + 1 : 0;
  char *path = NULL;
  if (asprintf(&path, "%.*s.%s.%ld.%s", parent, target, target + parent, (long)getpid(), kind) < 0)
    return NULL;
  return path;
}

// The folder and, in it, the files of these names alone.
static void remove_folder(const char *path, const term_file *files, int count) {
  int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  for (int i = 0; i < count; i++) unlinkat(folder, files[i].name, 0);
  close(folder);
  rmdir(path);
}

// 0 or errno.
static int write_file(const char *folder, const term_file *file) {
  if (!file->bytes) return 0;
  char *path = NULL;
  if (asprintf(&path, "%s/%s", folder, file->name) < 0) return ENOMEM;
  FILE *stream = fopen(path, "wxe");
  int number = stream ? 0 : errno;
  free(path);
  if (!stream) return number;
  if (fwrite(file->bytes, 1, file->size, stream) != file->size) number = errno;
  if (fclose(stream) != 0 && !number) number = errno;
  return number;
}

// Where the file system cannot exchange two folders at once: out of the way, and back if the new
// one cannot take its place.
static int replace_in_two(const char *aside, const char *target, const term_file *files,
                          int count) {
  char *old = path_aside(target, "old");
  if (!old) return ENOMEM;
  int number = rename(target, old) == 0 ? 0 : errno;
  if (!number && rename(aside, target) != 0) {
    number = errno;
    rename(old, target);
  }
  if (!number) remove_folder(old, files, count);
  free(old);
  return number;
}

static int replace(const char *aside, const char *target, const term_file *files, int count) {
  // Onto an empty folder, or where there is none, a plain rename does.
  if (rename(aside, target) == 0) return 0;
  if (errno != ENOTEMPTY && errno != EEXIST) return errno;
  if (renameat2(AT_FDCWD, aside, AT_FDCWD, target, RENAME_EXCHANGE) != 0)
    return replace_in_two(aside, target, files, count);
  remove_folder(aside, files, count);
  return 0;
}

static term_exit write_aside(const char *aside, const char *target, const term_file *files,
                             int count) {
  int number = mkdir(aside, 0777) == 0 ? 0 : errno;
  if (number) return fail(target, number);
  for (int i = 0; i < count && !number; i++) number = write_file(aside, &files[i]);
  if (!number) number = replace(aside, target, files, count);
  if (!number) return TERM_DONE;
  remove_folder(aside, files, count);
  return fail(target, number);
}

term_exit term_folder_write(const char *path, const term_file *files, int count) {
  char *target = plain_path(path);
  char *aside = target ? path_aside(target, "tmp") : NULL;
  term_exit code = aside ? check(target, files, count) : term_fail_bike(BIKE_ERROR_MEMORY, path);
  if (code == TERM_DONE) code = write_aside(aside, target, files, count);
  free(aside);
  free(target);
  return code;
}
