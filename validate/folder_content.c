// SPDX-License-Identifier: Apache-2.0
#include "folder_content.h"

#include "report.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

// The list of files of the report in a folder; NULL where there is none.
static json_t *load_files(int folder) {
  int descriptor = openat(folder, "report.json", O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  FILE *stream = descriptor >= 0 ? fdopen(descriptor, "r") : NULL;
  if (!stream) {
    if (descriptor >= 0) close(descriptor);
    return NULL;
  }
  json_t *document = json_loadf(stream, 0, NULL);
  fclose(stream);
  const char *schema = json_string_value(json_object_get(document, "schema"));
  json_t *files = NULL;
  if (schema && strcmp(schema, REPORT_SCHEMA) == 0)
    files = json_incref(json_object_get(document, "files"));
  json_decref(document);
  return files;
}

static bool is_listed(const json_t *files, const char *name) {
  size_t i;
  json_t *entry;
  json_array_foreach(files, i, entry) {
    const char *listed = json_string_value(entry);
    if (listed && strcmp(listed, name) == 0) return true;
  }
  return false;
}

static bool is_dot(const char *name) {
  return strcmp(name, ".") == 0 || strcmp(name, "..") == 0;
}

term_exit folder_content_check(const char *path, problem *p) {
  DIR *folder = opendir(path);
  if (!folder) return problem_system(p, path, errno);
  json_t *files = load_files(dirfd(folder));
  term_exit code = TERM_DONE;
  struct dirent *entry;
  while (code == TERM_DONE && (entry = readdir(folder))) {
    if (is_dot(entry->d_name) || is_listed(files, entry->d_name)) continue;
    code = problem_set(p, TERM_USAGE,
                       files ? "%s: holds '%s', which is not part of the report there"
                             : "%s: holds '%s' and is not a report: nothing is overwritten",
                       path, entry->d_name);
  }
  json_decref(files);
  closedir(folder);
  return code;
}

void folder_content_remove(const char *path) {
  DIR *folder = opendir(path);
  if (!folder) return;
  struct dirent *entry;
  while ((entry = readdir(folder)))
    if (!is_dot(entry->d_name)) unlinkat(dirfd(folder), entry->d_name, 0);
  closedir(folder);
  rmdir(path);
}
