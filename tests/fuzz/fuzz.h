// SPDX-License-Identifier: Apache-2.0
// What fuzz targets share. A target is one file that defines LLVMFuzzerTestOneInput: it hands bytes
// to a door of the project and demands what must hold whatever they are.
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Writes a file into this process's own folder in memory; its path, valid until the same name is
// written again. The folder is removed at exit.
const char *fuzz_write(const char *name, const void *bytes, size_t size);

// The same with the bytes of a file of the project: "model/benchmark/benchmark.yml".
const char *fuzz_copy(const char *name, const char *source);

// Whether a message says something, in one line without control characters.
bool fuzz_one_line(const char *text);

// Removes the folder and aborts.
void fuzz_abort(void) __attribute__((noreturn));

// What must hold. The sanitizers' report shows where it did not.
#define FUZZ_REQUIRE(condition, ...)                                                               \
  do {                                                                                             \
    if (!(condition)) {                                                                            \
      fprintf(stderr, "%s:%d: not so: %s: ", __FILE__, __LINE__, #condition);                      \
      fprintf(stderr, __VA_ARGS__);                                                                \
      fputc('\n', stderr);                                                                         \
      fuzz_abort();                                                                                \
    }                                                                                              \
  } while (0)

//---------------------------------- bytes as choices ----------------------------------------------

// The input read as a list of choices, for targets that make a structure of it. At its end all
// choices are 0.
typedef struct fuzz_bytes {
  const uint8_t *data;
  size_t left;
} fuzz_bytes;

unsigned fuzz_byte(fuzz_bytes *bytes);
unsigned fuzz_below(fuzz_bytes *bytes, unsigned count); // 0 .. count - 1

// Zeros, ones, tiny, huge and ordinary numbers, now and then any bits at all.
double fuzz_number(fuzz_bytes *bytes);

#endif
