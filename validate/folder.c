// SPDX-License-Identifier: Apache-2.0
#include "folder.h"

#include "folder_content.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static term_exit fail(const char *path, int number, problem *p) {
  return problem_set(p, TERM_USAGE, "%s: %s", path, strerror(number));
}

// The path without slashes at its end, a symbolic link to a folder followed; NULL without memory.
static char *plain_path(const char *path) {
  char *real = realpath(path, NULL);
  if (real) return real;
  char *copy = strdup(path);
  size_t length = copy ? strlen(copy) : 0;
  while (length > 1 && copy[length - 1] == '/') copy[--length] = '\0';
  return copy;
}

// "PARENT/.NAME.PID-SUFFIX.tmp"; NULL when out of memory.
static char *path_aside(const char *target, const char *suffix) {
  const char *slash = strrchr(target, '/');
  int parent = slash ? (int)(slash - target) + 1 : 0;
  char *path = NULL;
  if (asprintf(&path, "%.*s.%s.%ld-%s.tmp", parent, target, target + parent, (long)getpid(),
               suffix) < 0)
    return NULL;
  return path;
}

// Whether a new folder can be made beside the target.
static term_exit check_parent(const char *target, problem *p) {
  char *copy = strdup(target);
  if (!copy) return problem_memory(p);
  const char *parent = dirname(copy);
  struct stat status;
  term_exit code = TERM_DONE;
  if (stat(parent, &status) != 0)
    code = fail(parent, errno, p);
  else if (!S_ISDIR(status.st_mode))
    code = fail(parent, ENOTDIR, p);
  else if (access(parent, W_OK | X_OK) != 0)
    code = fail(parent, errno, p);
  free(copy);
  return code;
}

static term_exit check_target(const char *target, problem *p) {
  struct stat status;
  if (lstat(target, &status) != 0)
    return errno == ENOENT ? check_parent(target, p) : fail(target, errno, p);
  if (!S_ISDIR(status.st_mode))
    return problem_set(p, TERM_USAGE, "%s: is there and is not a folder", target);
  term_exit code = folder_content_check(target, p);
  return code == TERM_DONE ? check_parent(target, p) : code;
}

term_exit folder_check(const char *path, problem *p) {
  if (!*path) return problem_set(p, TERM_USAGE, "the name of the output folder is empty");
  char *target = plain_path(path);
  term_exit code = target ? check_target(target, p) : problem_memory(p);
  free(target);
  return code;
}

// What ends a program from outside and can be made to wait.
static sigset_t ending_signals(void) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGHUP);
  sigaddset(&set, SIGQUIT);
  return set;
}

bool folder_is_interrupted(void) {
  const sigset_t ending = ending_signals();
  sigset_t waiting, both;
  sigemptyset(&waiting);
  sigpending(&waiting);
  sigandset(&both, &waiting, &ending);
  return !sigisemptyset(&both);
}

// From here on signals end the program again; one that has waited does so now.
static void forget(folder *f) {
  const sigset_t before = f->signals;
  free(f->target);
  free(f->aside);
  *f = (folder){0};
  pthread_sigmask(SIG_SETMASK, &before, NULL);
}

term_exit folder_begin(folder *out, const char *path, problem *p) {
  *out = (folder){0};
  term_exit code = folder_check(path, p);
  if (code != TERM_DONE) return code;
  const sigset_t ending = ending_signals();
  pthread_sigmask(SIG_BLOCK, &ending, &out->signals);
  out->target = plain_path(path);
  out->aside = out->target ? path_aside(out->target, "new") : NULL;
  if (out->aside) folder_content_remove(out->aside); // of a killed process with our number
  if (out->aside && mkdir(out->aside, 0777) == 0) return TERM_DONE;
  code = out->aside ? fail(path, errno, p) : problem_memory(p);
  forget(out);
  return code;
}

FILE *folder_open(const folder *f, const char *name, problem *p) {
  char *path = NULL;
  if (asprintf(&path, "%s/%s", f->aside, name) < 0) {
    problem_memory(p);
    return NULL;
  }
  FILE *stream = fopen(path, "wxe");
  if (!stream) fail(name, errno, p);
  free(path);
  return stream;
}

term_exit folder_close(FILE *stream, const char *name, problem *p) {
  errno = 0;
  bool failed = ferror(stream) != 0;
  failed |= fclose(stream) != 0;
  return failed ? fail(name, errno ? errno : EIO, p) : TERM_DONE;
}

// Where the file system cannot exchange two folders at once: out of the way, and back if the new
// one cannot take its place.
static bool replace_in_two(const folder *f) {
  char *old = path_aside(f->target, "old");
  bool moved = old && rename(f->target, old) == 0;
  bool replaced = moved && rename(f->aside, f->target) == 0;
  int number = errno;
  if (replaced) folder_content_remove(old);
  if (moved && !replaced) rename(old, f->target);
  free(old);
  errno = number;
  return replaced;
}

// Puts the new folder in the place of an earlier report.
static bool replace(const folder *f) {
  // Onto an empty folder, or where there is none, a plain rename does.
  if (rename(f->aside, f->target) == 0) return true;
  if (errno != ENOTEMPTY && errno != EEXIST) return false;
  if (renameat2(AT_FDCWD, f->aside, AT_FDCWD, f->target, RENAME_EXCHANGE) != 0)
    return replace_in_two(f);
  folder_content_remove(f->aside);
  return true;
}

term_exit folder_commit(folder *f, problem *p) {
  term_exit code = check_target(f->target, p); // it may have changed meanwhile
  if (code == TERM_DONE && !replace(f)) code = fail(f->target, errno, p);
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
