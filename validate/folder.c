// SPDX-License-Identifier: Apache-2.0
#include "folder.h"

#include "folder_content.h"
#include "terminal/folder_place.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Whether a new folder can be made beside the target.
static term_exit check_parent(const char *target, problem *p) {
  char *parent = term_place_parent(target);
  if (!parent) return problem_memory(p);
  int number = term_place_check_parent(parent);
  term_exit code = number ? problem_system(p, parent, number) : TERM_DONE;
  free(parent);
  return code;
}

static term_exit check_target(const char *target, problem *p) {
  struct stat status;
  if (lstat(target, &status) != 0)
    return errno == ENOENT ? check_parent(target, p) : problem_system(p, target, errno);
  if (!S_ISDIR(status.st_mode))
    return problem_set(p, TERM_USAGE, "%s: is there and is not a folder", target);
  term_exit code = folder_content_check(target, p);
  return code == TERM_DONE ? check_parent(target, p) : code;
}

term_exit folder_check(const char *path, problem *p) {
  if (!*path) return problem_set(p, TERM_USAGE, "the name of the output folder is empty");
  char *target = term_place_of(path);
  term_exit code = target ? check_target(target, p) : problem_memory(p);
  free(target);
  return code;
}

// From here on signals end the program again; one that has waited does so now.
static void forget(folder *f) {
  const sigset_t before = f->signals;
  free(f->target);
  free(f->aside);
  *f = (folder){0};
  term_release_signals(&before);
}

term_exit folder_begin(folder *out, const char *path, problem *p) {
  *out = (folder){0};
  term_exit code = folder_check(path, p);
  if (code != TERM_DONE) return code;
  term_hold_signals(&out->signals);
  out->target = term_place_of(path);
  out->aside = out->target ? term_place_aside(out->target, "tmp") : NULL;
  if (out->aside) folder_content_remove(out->aside); // of a killed process with our number
  if (out->aside && mkdir(out->aside, 0777) == 0) return TERM_DONE;
  code = out->aside ? problem_system(p, path, errno) : problem_memory(p);
  forget(out);
  return code;
}

term_exit folder_open(FILE **out, const folder *f, const char *name, problem *p) {
  char *path = NULL;
  if (asprintf(&path, "%s/%s", f->aside, name) < 0) return problem_memory(p);
  *out = fopen(path, "wxe");
  term_exit code = *out ? TERM_DONE : problem_system(p, name, errno);
  free(path);
  return code;
}

term_exit folder_close(FILE *stream, const char *name, problem *p) {
  errno = 0;
  bool failed = ferror(stream) != 0;
  failed |= fclose(stream) != 0;
  return failed ? problem_system(p, name, errno ? errno : EIO) : TERM_DONE;
}

static void remove_report(const char *path, const void *unused) {
  (void)unused;
  folder_content_remove(path);
}

term_exit folder_commit(folder *f, problem *p) {
  term_exit code = check_target(f->target, p); // it may have changed meanwhile
  int number = code == TERM_DONE ? term_place_take(f->aside, f->target, remove_report, NULL) : 0;
  if (number) code = problem_system(p, f->target, number);
  if (code != TERM_DONE) {
    folder_abort(f);
    return code;
  }
  forget(f);
  return TERM_DONE;
}

void folder_abort(folder *f) {
  if (!f->aside) return;
  folder_content_remove(f->aside);
  forget(f);
}
