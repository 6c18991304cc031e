// SPDX-License-Identifier: Apache-2.0
// Mutations of text files: every other one changes a number to another one. Without it nearly all
// inputs fail in the parser, and few values beyond the seeds' reach what judges them.
#include "fuzz.h"

#include <ctype.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most); // libFuzzer's own
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);

static bool in_number(unsigned char c) {
  return isdigit(c) || c == '.' || c == '-' || c == '+';
}

// Where a number begins, searched from a random place on; `size` if there is none.
static size_t find_number(const uint8_t *data, size_t size, size_t from) {
  for (size_t i = from; i < size; i++)
    if (isdigit(data[i]) && (i == 0 || !isalnum(data[i - 1]))) {
      while (i > 0 && in_number(data[i - 1])) i--;
      return i;
    }
  return size;
}

static const char *another(const char *old, unsigned choice) {
  static const char *const values[] = {"0",    "1",     "-1",     "1e-9", "1e6",
                                       "1e15", "1e300", "1e-300", "629",  "3.2"};
  enum { COUNT = sizeof values / sizeof *values };
  static char text[64];
  if (choice % 2 == 0) return values[choice / 2 % COUNT];
  double value = strtod(old, NULL);
  const double factors[] = {-1, -1, 10, 0.1, 1000, 1.001};
  snprintf(text, sizeof text, "%.9g", value * factors[choice / 2 % 6]);
  return text;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed) {
  char old[32] = "";
  size_t begin = size ? find_number(data, size, (seed >> 8) % size) : size, end = begin;
  if (seed % 2 == 0 || begin == size) return LLVMFuzzerMutate(data, size, most);
  while (end < size && in_number(data[end])) end++;
  memcpy(old, data + begin, end - begin < sizeof old ? end - begin : sizeof old - 1);
  const char *text = another(old, seed / 2 % 128);
  size_t length = strlen(text);
  if (size - (end - begin) + length > most) return LLVMFuzzerMutate(data, size, most);
  memmove(data + begin + length, data + end, size - end);
  memcpy(data + begin, text, length);
  return size - (end - begin) + length;
}
