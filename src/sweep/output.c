// SPDX-License-Identifier: Apache-2.0
#include "output.h"

typedef struct description {
  const char *name;
  bool needs_speed;
} description;

static const description all[SWEEP_OUTPUT_COUNT] = {
#define SWEEP_ENTRY(code, name, speed, meaning) [code] = {name, speed},
    SWEEP_OUTPUTS(SWEEP_ENTRY)
#undef SWEEP_ENTRY
};

const char *sweep_output_name(sweep_output output) {
  return all[output].name;
}

bool sweep_output_needs_speed(sweep_output output) {
  return all[output].needs_speed;
}
