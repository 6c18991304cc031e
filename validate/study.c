// SPDX-License-Identifier: Apache-2.0
#include "study.h"

#include <stdlib.h>

const char *const study_signals[STUDY_SIGNALS] = {"lean", "steer"};

const char *study_verdict_string(study_verdict v) {
  static const char *const texts[] = {"same equations", "different model", "another order"};
  return texts[v];
}

void study_clear(study_results *s) {
  free(s->linear.modes);
  *s = (study_results){0};
}
