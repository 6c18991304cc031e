// SPDX-License-Identifier: Apache-2.0
// Broken bicycle files: a good one with one thing changed, and the message it must give.
#ifndef TESTS_FILES_WRONG_EDITS_H
#define TESTS_FILES_WRONG_EDITS_H

#include <bicycle/error.h>

typedef struct wrong_edit {
  const char *good;    // one of samples.h
  const char *from;    // the first occurrence of this text
  const char *to;      // becomes this
  int code;            //
  const char *message; // after the path; a prefix of the message
} wrong_edit;

extern const wrong_edit WRONG_EDITS[];
extern const int WRONG_EDIT_COUNT;

#endif
