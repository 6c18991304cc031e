// SPDX-License-Identifier: Apache-2.0
#include "terminal/folder.h"

#include "terminal/folder_place.h"
#include "terminal/hold.h"
#include "terminal/message.h"

#include <bicycle/error.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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
  if (!folder) return term_fail_system(errno, path);
  term_exit code = TERM_DONE;
  for (struct dirent *entry = readdir(folder); entry && code == TERM_DONE; entry = readdir(folder))
    if (!is_ours(entry->d_name, files, count) || is_folder(folder, entry->d_name))
      code =
          term_fail(TERM_USAGE, "%s: not replaced, since it also holds '%s'", path, entry->d_name);
  closedir(folder);
  return code;
}

static term_exit check_parent(const char *target) {
  char *parent = term_place_parent(target);
  if (!parent) return term_fail_bike(BIKE_ERROR_MEMORY, target);
  int number = term_place_check_parent(parent);
  term_exit code = number ? term_fail_system(number, parent) : TERM_DONE;
  free(parent);
  return code;
}

static term_exit check(const char *target, const term_file *files, int count) {
  struct stat status;
  term_exit code = TERM_DONE;
  if (stat(target, &status) == 0)
    code = S_ISDIR(status.st_mode) ? check_content(target, files, count)
                                   : term_fail_system(ENOTDIR, target);
  else if (errno != ENOENT)
    code = term_fail_system(errno, target);
  return code == TERM_DONE ? check_parent(target) : code;
}

term_exit term_folder_check(const char *path, const term_file *files, int count) {
  char *target = term_place_of(path);
  term_exit code = target ? check(target, files, count) : term_fail_bike(BIKE_ERROR_MEMORY, path);
  free(target);
  return code;
}

//---------------------------------- writing -------------------------------------------------------

typedef struct file_list {
  const term_file *files;
  int count;
} file_list;

// The folder and, in it, the files of these names alone.
static void remove_folder(const char *path, const void *user) {
  const file_list *list = user;
  int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  for (int i = 0; i < list->count; i++) unlinkat(folder, list->files[i].name, 0);
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

// 0 or errno: then nothing is left of it.
static int write_aside(const char *aside, const char *target, const file_list *list) {
  remove_folder(aside, list); // of a killed process with our number
  if (mkdir(aside, 0777) != 0) return errno;
  int number = 0;
  for (int i = 0; i < list->count && !number; i++)
    number = term_signal_waits() ? EINTR : write_file(aside, &list->files[i]);
  if (!number) number = term_place_take(aside, target, remove_folder, list);
  if (number) remove_folder(aside, list);
  return number;
}

// An end from outside comes after it, and before anything is said.
static term_exit write_held(const char *aside, const char *target, const file_list *list) {
  sigset_t before;
  term_hold_signals(&before);
  int number = write_aside(aside, target, list);
  term_release_signals(&before);
  return number ? term_fail_system(number, target) : TERM_DONE;
}

term_exit term_folder_write(const char *path, const term_file *files, int count) {
  char *target = term_place_of(path);
  char *aside = target ? term_place_aside(target, "tmp") : NULL;
  term_exit code = aside ? check(target, files, count) : term_fail_bike(BIKE_ERROR_MEMORY, path);
  if (code == TERM_DONE) code = write_held(aside, target, &(file_list){files, count});
  free(aside);
  free(target);
  return code;
}
