// SPDX-License-Identifier: Apache-2.0
#include "batch/lanes.h"

#include "equations/instruction_set.h"

static const lanes_functions *const instances[] = {
    [INSTRUCTIONS_BASELINE] = &lanes_baseline,
#ifdef BICYCLE_X86_64_LEVELS
    [INSTRUCTIONS_V3] = &lanes_v3,
    [INSTRUCTIONS_V4] = &lanes_v4,
#endif
};

const lanes_functions *lanes_in_use(void) {
  return instances[instruction_set_in_use()];
}
