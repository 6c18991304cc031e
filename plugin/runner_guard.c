// SPDX-License-Identifier: Apache-2.0
#include "runner_guard.h"

#include <mujoco/mujoco.h>
#include <pthread.h>
#include <setjmp.h>
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

static void on_error(const char *text) {
  guard *g = innermost;
  if (g) {
    keep(g->report->error, text);
    g->report->failed = true;
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

static void set_handlers(void) {
  previous_error = mju_user_error;
  previous_warning = mju_user_warning;
  mju_user_error = on_error;
  mju_user_warning = on_warning;
}

void guard_call(guard_report *report, void (*function)(void *), void *argument) {
  pthread_once(&handlers_are_set, set_handlers);
  memset(report, 0, sizeof *report);
  guard g = {.report = report, .outer = innermost};
  innermost = &g;
  if (setjmp(g.exit) == 0) function(argument);
  innermost = g.outer;
}
