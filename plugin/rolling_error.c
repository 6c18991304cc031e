// SPDX-License-Identifier: Apache-2.0
// Texts of errors, and warnings that are given once.
#include "rolling_internal.h"

#include <stdatomic.h>
#include <stdio.h>

const char *roll_error_string(roll_error error) {
  static const char *const text[] = {
#define ROLL_ERROR_TEXT(code, text) text,
      ROLL_ERRORS(ROLL_ERROR_TEXT)
#undef ROLL_ERROR_TEXT
  };
  int known = (int)error >= 0 && (size_t)error < sizeof text / sizeof *text;
  return known ? text[error] : "unknown error of the rolling discs";
}

const char *roll_fault_string(char *text, int size, roll_error error, roll_object where,
                              const mjModel *m) {
  const char *what = roll_error_string(error), *type = mju_type2Str(where.type);
  const char *name = type ? mj_id2name(m, where.type, where.id) : NULL;
  if (name)
    snprintf(text, (size_t)size, "%s (%s '%s')", what, type, name);
  else if (type)
    snprintf(text, (size_t)size, "%s (%s %d)", what, type, where.id);
  else
    snprintf(text, (size_t)size, "%s", what);
  return text;
}

void roll_warn(roll_message message, const char *text, const mjModel *m, const mjData *d) {
  static atomic_bool said[ROLL_MESSAGES]; // changes what is said, never what is computed
  // The compiler takes one step of its own, whose last stage ends at one timestep: quiet until
  // then.
  if (!(d->time > 1.5 * m->opt.timestep)) return;
  if (!atomic_exchange(&said[message], 1)) mju_warning(text);
}

void roll_warn_of(roll_message message, roll_error error, roll_object where, const mjModel *m,
                  const mjData *d) {
  char text[512]; // the longest error and a name of some length
  roll_warn(message, roll_fault_string(text, sizeof text, error, where, m), m, d);
}
