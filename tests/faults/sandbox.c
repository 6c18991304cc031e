// SPDX-License-Identifier: Apache-2.0
#include "sandbox.h"

#include "fault_ledger.h"

#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char home[64], run[80];
static sandbox_content *looking;

static void need(bool done, const char *what) {
  if (done) return;
  perror(what);
  exit(2);
}

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *place) {
  (void)info, (void)kind;
  return place->level == 0 && strcmp(path, run) == 0 ? 0 : remove(path);
}

static void leave(void) {
  nftw(home, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
  rmdir(run);
  rmdir(home);
}

void sandbox_enter(void) {
  char path[80], search[8192];
  const char *old = getenv("PATH");
  snprintf(home, sizeof home, "/tmp/bicycle-faults-XXXXXX");
  need(mkdtemp(home) != NULL, home);
  snprintf(run, sizeof run, "%s/run", home);
  snprintf(path, sizeof path, "%s/in", home);
  need(mkdir(run, 0777) == 0 && mkdir(path, 0777) == 0, home);
  snprintf(search, sizeof search, "%s/bin:%s/tests:%s", BICYCLE_BINARY_DIR, BICYCLE_BINARY_DIR,
           old ? old : "/usr/bin:/bin");
  need(setenv("PATH", search, 1) == 0, "PATH");
  atexit(leave);
}

const char *sandbox_home(void) {
  return home;
}

void sandbox_clean(void) {
  nftw(run, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

void sandbox_shell(const char *command) {
  char whole[4096];
  int length = snprintf(whole, sizeof whole, "cd %s && { %s; }", run, command);
  need(length < (int)sizeof whole, "command");
  if (system(whole) != 0) {
    fprintf(stderr, "failed: %s\n", command);
    exit(2);
  }
}

// Never returns.
static void become(const char *command, const char *preload, int ledger, unsigned seconds) {
  char text[1024], *words[64], *rest = text;
  int count = 0;
  snprintf(text, sizeof text, "%s", command);
  while (count < 63 && (words[count] = strsep(&rest, " "))) count += *words[count] != '\0';
  words[count] = NULL;
  if (ledger >= 0 && dup2(ledger, LEDGER_DESCRIPTOR) < 0) _exit(126);
  int err = open("../stderr", O_WRONLY | O_CREAT | O_TRUNC, 0666);
  int out = open("stdout", O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (out < 0 || err < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0) _exit(126);
  close(out);
  close(err);
  if (preload && setenv("LD_PRELOAD", preload, 1) != 0) _exit(126);
  alarm(seconds);
  execvp(words[0], words);
  _exit(127);
}

pid_t sandbox_start(const char *command, const char *preload, int ledger, unsigned seconds) {
  pid_t child = fork();
  need(child >= 0, "fork");
  if (child == 0) {
    if (chdir(run) != 0) _exit(126);
    become(command, preload, ledger, seconds);
  }
  return child;
}

int sandbox_wait(pid_t child) {
  int status = 0;
  need(waitpid(child, &status, 0) == child, "waitpid");
  return status;
}

//---------------------------------- what is left --------------------------------------------------

static uint64_t hash_of(const char *path) {
  uint64_t hash = 14695981039346656037U;
  unsigned char bytes[16384];
  FILE *file = fopen(path, "r");
  if (!file) return 0;
  for (size_t size; (size = fread(bytes, 1, sizeof bytes, file)) > 0;)
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * 1099511628211U;
  fclose(file);
  return hash;
}

static int add_entry(const char *path, const struct stat *info, int kind, struct FTW *place) {
  if (place->level == 0 || looking->count == SANDBOX_MOST_FILES) return 0;
  sandbox_file *file = &looking->files[looking->count++];
  snprintf(file->path, sizeof file->path, "%s", path + strlen(run) + 1);
  file->size = kind == FTW_F ? (size_t)info->st_size : 0;
  file->hash = kind == FTW_F ? hash_of(path) : 0;
  return 0;
}

static int by_path(const void *a, const void *b) {
  return strcmp(((const sandbox_file *)a)->path, ((const sandbox_file *)b)->path);
}

void sandbox_look(sandbox_content *out) {
  out->count = 0;
  looking = out;
  nftw(run, add_entry, 8, FTW_PHYS);
  qsort(out->files, (size_t)out->count, sizeof *out->files, by_path);
}

const sandbox_file *sandbox_find(const sandbox_content *content, const char *path) {
  for (int i = 0; i < content->count; i++)
    if (strcmp(content->files[i].path, path) == 0) return &content->files[i];
  return NULL;
}

bool sandbox_same(const sandbox_content *a, const sandbox_content *b) {
  if (a->count != b->count) return false;
  for (int i = 0; i < a->count; i++)
    if (strcmp(a->files[i].path, b->files[i].path) != 0 || a->files[i].size != b->files[i].size ||
        a->files[i].hash != b->files[i].hash)
      return false;
  return true;
}

void sandbox_message(char *out, size_t size) {
  char path[80];
  snprintf(path, sizeof path, "%s/stderr", home);
  FILE *file = fopen(path, "r");
  size_t used = file ? fread(out, 1, size - 1, file) : 0;
  if (file) fclose(file);
  out[used] = '\0';
  for (char *c = out; *c; c++)
    if (*c == '\n') *c = ' ';
}
