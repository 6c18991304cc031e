// SPDX-License-Identifier: Apache-2.0
#include "layer.h"

#include <string.h>

static const layer *const layers[] = {&layer_parameters, &layer_instant,    &layer_linear,
                                      &layer_traces,     &layer_invariants, &layer_convergence,
                                      &layer_horizon,    &layer_cost};

enum { LAYER_COUNT = sizeof layers / sizeof layers[0] };

const layer *layer_at(int index) {
  return index >= 0 && index < LAYER_COUNT ? layers[index] : NULL;
}

const layer *layer_find(const char *name) {
  for (int i = 0; i < LAYER_COUNT; i++)
    if (strcmp(layers[i]->name, name) == 0) return layers[i];
  return NULL;
}

bool layer_needs(const comparison *c, const trace_signal *signal, size_t row) {
  for (int i = 0; i < LAYER_COUNT; i++)
    if (layers[i]->needs && layers[i]->needs(c, signal, row)) return true;
  return false;
}

bool layer_names(const char *const *list, const char *word) {
  for (; *list; list++)
    if (strcmp(*list, word) == 0) return true;
  return false;
}
