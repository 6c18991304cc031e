// SPDX-License-Identifier: Apache-2.0
// For lower.py: a plain number where a `real` belongs.
typedef struct real real;

typedef struct vec {
  real x, y;
} vec;

static inline vec flat(real a) {
  return (vec){a, 0.0};
}
