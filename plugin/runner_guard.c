// SPDX-License-Identifier: Apache-2.0
#include "runner_guard.h"

#include <dlfcn.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct guard {
  guard_report *report;
  struct guard *outer;
  jmp_buf exit;
} guard;

// MuJoCo's handlers get a text and nothing else: the guarded call of a thread must be found here.
static _Thread_local guard *innermost;

// Handlers found at the first guarded call; not changed after.
static void (*previous_error)(const char *);
static void (*previous_warning)(const char *);
static pthread_once_t handlers_are_set = PTHREAD_ONCE_INIT; // which the thread sanitizer knows

static void keep(char out[GUARD_TEXT_SIZE], const char *text) {
  snprintf(out, GUARD_TEXT_SIZE, "%s", text);
  for (char *c = out; *c; c++)
    if (*c == '\n' || *c == '\r') *c = ' ';
}

bool guard_tells_of_memory(const char *text) {
  return strstr(text, "ould not allocate") != NULL;
}

static void on_error(const char *text) {
  guard *g = innermost;
  if (g) {
    keep(g->report->error, text);
    g->report->failed = true;
    g->report->no_memory = guard_tells_of_memory(text);
    longjmp(g->exit, 1);
  }
  if (previous_error) previous_error(text);
  // Nobody can go on: MuJoCo's own handler would wait for a key first.
  fprintf(stderr, "MuJoCo error: %s\n", text);
  abort();
}

static void on_warning(const char *text) {
  guard *g = innermost;
  if (!g) {
    if (previous_warning)
      previous_warning(text);
    else
      fprintf(stderr, "MuJoCo warning: %s\n", text);
    return;
  }
  if (g->report->warnings++ == 0) keep(g->report->warning, text);
}

// std::set_new_handler, of the C++ library that MuJoCo brings. MuJoCo lets no exception out of its
// functions: without a handler those that compile a model end the program for want of memory.
typedef void new_handler(void);
static new_handler *(*set_new_handler)(new_handler *);

static atomic_bool exhausted;

static void on_no_memory(void) {
  guard *g = innermost;
  if (!g) {
    set_new_handler(NULL); // operator new tries again, and throws
    return;
  }
  atomic_store(&exhausted, true);
  longjmp(g->exit, 1);
}

static void set_handlers(void) {
  *(void **)&set_new_handler = dlsym(RTLD_DEFAULT, "_ZSt15set_new_handlerPFvvE");
  if (set_new_handler) set_new_handler(on_no_memory);
  previous_error = mju_user_error;
  previous_warning = mju_user_warning;
  mju_user_error = on_error;
  mju_user_warning = on_warning;
}

static void tell_of_no_memory(guard_report *report) {
  report->failed = report->no_memory = true;
  keep(report->error, "out of memory");
}

void guard_call(guard_report *report, void (*function)(void *), void *argument) {
  pthread_once(&handlers_are_set, set_handlers);
  memset(report, 0, sizeof *report);
  guard g = {.report = report, .outer = innermost};
  innermost = &g;
  if (!atomic_load(&exhausted) && setjmp(g.exit) == 0) function(argument);
  innermost = g.outer;
  if (atomic_load(&exhausted)) tell_of_no_memory(report);
}

bool guard_fail(mjcf_error *error, const guard_report *report) {
  return report->no_memory ? mjcf_fail_memory(error) : mjcf_fail(error, "%s", report->error);
}

//---------------------------------- calls that only want memory -----------------------------------

typedef struct want {
  const mjModel *model;
  mjData *data;
  mjModel *copy;
  mjVFS *vfs;
  const char *name;
  int size;
  bool made;
} want;

static void make_data(void *argument) {
  want *w = (want *)argument;
  w->data = mj_makeData(w->model);
}

static void copy_model(void *argument) {
  want *w = (want *)argument;
  w->copy = mj_copyModel(NULL, w->model);
}

static void make_file(void *argument) {
  want *w = (want *)argument;
  w->made = mj_makeEmptyFileVFS(w->vfs, w->name, w->size) == 0;
}

mjData *guard_make_data(const mjModel *model) {
  want w = {.model = model};
  guard_report report;
  guard_call(&report, make_data, &w);
  return w.data;
}

mjModel *guard_copy_model(const mjModel *model) {
  want w = {.model = model};
  guard_report report;
  guard_call(&report, copy_model, &w);
  return w.copy;
}

bool guard_make_file(mjVFS *vfs, const char *name, int size) {
  want w = {.vfs = vfs, .name = name, .size = size};
  guard_report report;
  guard_call(&report, make_file, &w);
  return w.made;
}
