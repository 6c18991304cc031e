// SPDX-License-Identifier: Apache-2.0
// For lower.py, which knows no branches but on whether a pointer is NULL.
typedef struct real real;

static inline real larger(real a, real b, int first) {
  if (first) return a;
  return b;
}
