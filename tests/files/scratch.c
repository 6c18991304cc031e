// SPDX-License-Identifier: Apache-2.0
#include "scratch.h"

#include "support/near.h"

#include <dirent.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[64];

int scratch_create(void **state) {
  (void)state;
  snprintf(folder, sizeof folder, "/tmp/bicycle-test-XXXXXX");
  return mkdtemp(folder) && chmod(folder, 0755) == 0 ? 0 : -1;
}

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *ftw) {
  (void)status;
  (void)kind;
  (void)ftw;
  return remove(path);
}

int scratch_remove(void **state) {
  (void)state;
  return nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

const char *scratch_folder(void) {
  return folder;
}

const char *scratch_path(const char *name) {
  static char path[SCRATCH_PATH_SIZE];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return path;
}

const char *scratch_write_bytes(const char *name, const void *bytes, size_t size) {
  const char *path = scratch_path(name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  assert_int_equal(fwrite(bytes, 1, size, file), size);
  assert_int_equal(fclose(file), 0);
  return path;
}

const char *scratch_write(const char *name, const char *text) {
  return scratch_write_bytes(name, text, strlen(text));
}

char *scratch_read(const char *path) {
  char *text = NULL;
  size_t capacity = 0;
  FILE *file = fopen(path, "r");
  assert_non_null(file);
  if (getdelim(&text, &capacity, '\0', file) < 0) { // an empty file
    free(text);
    text = calloc(1, 1);
  }
  fclose(file);
  assert_non_null(text);
  return text;
}

int scratch_count(void) {
  int count = 0;
  DIR *directory = opendir(folder);
  assert_non_null(directory);
  for (const struct dirent *entry; (entry = readdir(directory));)
    count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
  closedir(directory);
  return count;
}

void scratch_be_nobody(bool may_add) {
  const uid_t nobody = 65534;
  assert_int_equal(chmod(folder, may_add ? 0777 : 0555), 0);
  if (getuid() == 0) assert_int_equal(seteuid(nobody), 0);
}

void scratch_be_self(void) {
  if (getuid() == 0) assert_int_equal(seteuid(0), 0);
  assert_int_equal(chmod(folder, 0755), 0);
}
