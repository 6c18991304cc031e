// SPDX-License-Identifier: Apache-2.0
#include "terminal/message.h"

#include "terminal/json.h"

#include <bicycle/error.h>
#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *program_name = "bicycle";

static atomic_bool lost;

void term_lose(void) {
  atomic_store(&lost, true);
}

bool term_has_lost(void) {
  return atomic_load(&lost);
}

// Runs at exit: a result that was lost on its way must not look like one, nor what follows from a
// loss like a fault of the input. Streams are not flushed again after it, hence _exit.
static void check_results(int status, void *unused) {
  (void)unused;
  if (term_has_lost() && status <= TERM_BASELINE && status != TERM_INVALID) {
    term_message("out of memory");
    fflush(stdout);
    _exit(TERM_INVALID);
  }
  if (status != TERM_DONE) return;
  errno = 0;
  bool failed = ferror(stdout) != 0;
  if (fflush(stdout) != 0 || failed) {
    term_message("standard output: %s", errno ? strerror(errno) : "write error");
    _exit(TERM_USAGE);
  }
}

void term_begin(const char *program) {
  static bool begun = false;
  program_name = program;
  if (begun) return;
  begun = true;
  term_json_begin();
  on_exit(check_results, NULL);
  signal(SIGXFSZ, SIG_IGN); // a limit on files (ulimit -f) is then an error of the write, told
}

const char *term_program(void) {
  return program_name;
}

static void message_va(const char *format, va_list arguments) {
  char *text = NULL;
  if (vasprintf(&text, format, arguments) < 0) text = NULL;
  for (char *c = text; c && *c; c++)
    if ((unsigned char)*c < ' ') *c = ' ';
  fprintf(stderr, "%s: %s\n", program_name, text ? text : "out of memory");
  free(text);
}

void term_message(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  message_va(format, arguments);
  va_end(arguments);
}

term_exit term_fail(term_exit code, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  message_va(format, arguments);
  va_end(arguments);
  return code;
}

term_exit term_exit_of(int code) {
  switch ((bike_error)code) {
  case BIKE_OK:
    return TERM_DONE;
  case BIKE_ERROR_MEMORY:
  case BIKE_ERROR_SOLVER:
  case BIKE_ERROR_NO_CONVERGENCE:
  case BIKE_ERROR_FULL:
  case BIKE_ERROR_INTERRUPTED:
    return TERM_INVALID;
  default:
    return TERM_USAGE;
  }
}

term_exit term_fail_system(int number, const char *subject) {
  if (number == ENOMEM) return term_fail_bike(BIKE_ERROR_MEMORY, subject);
  return term_fail(TERM_USAGE, "%s: %s", subject, strerror(number));
}

term_exit term_fail_bike(int code, const char *subject) {
  return term_fail(term_exit_of(code), "%s: %s", subject, bike_error_string(code));
}
