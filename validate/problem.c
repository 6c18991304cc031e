// SPDX-License-Identifier: Apache-2.0
#include "problem.h"

#include "files/message.h"
#include "files/text.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

term_exit problem_set(problem *p, term_exit code, const char *format, ...) {
  problem said; // the arguments may be of `p`
  va_list arguments;
  va_start(arguments, format);
  bike_message_fit(said.text, sizeof said.text, format, arguments);
  va_end(arguments);
  bike_text_name(p->text, sizeof p->text, said.text, strlen(said.text)); // names hold anything
  return code;
}

term_exit problem_memory(problem *p) {
  return problem_set(p, TERM_INVALID, "out of memory");
}

term_exit problem_system(problem *p, const char *path, int number) {
  if (number == ENOMEM) return problem_memory(p);
  return problem_set(p, TERM_USAGE, "%s: %s", path, strerror(number));
}

term_exit problem_prefix(problem *p, term_exit code, const char *prefix) {
  problem whole = *p;
  size_t length = strnlen(prefix, PROBLEM_SIZE / 2); // what went wrong matters more
  snprintf(p->text, sizeof p->text, "%.*s: %.*s", (int)length, prefix,
           (int)(PROBLEM_SIZE - length - 3), whole.text);
  return code;
}
