// SPDX-License-Identifier: Apache-2.0
// For lower.py: a plain number added to a `real`.
typedef struct real real;

static inline real shifted(real a) {
  return a + 1.0;
}
