// SPDX-License-Identifier: Apache-2.0
// A layer: one kind of question to two engines. Layers stand in order: what a layer finds wrong is
// news only if the layers before it found nothing, so the first that fails says where the fault is.
//
// A layer is one const struct. To add one, write layer_NAME.c and name its struct in layers.c.
#ifndef VALIDATE_LAYER_H
#define VALIDATE_LAYER_H

#include "comparison.h"

typedef struct layer {
  const char *name;    // "L0"
  const char *title;   // "instant"
  const char *agreed;  // what is known when its gates hold: "the parameters agree"
  const char *failure; // what it means when this is the first layer to fail, without that

  // Whether the layer measures that metric of that signal; NULL: of any signal.
  bool (*knows)(const char *signal, const char *metric);

  // Whether it judges or compares that signal of a side in that row, which both traces may have;
  // NULL: no signals of rides, or none but those of other layers.
  bool (*needs)(const comparison *c, const trace_signal *signal, size_t row);

  // Asks both engines and adds what comes out to the comparison's measurements.
  term_exit (*measure)(comparison *c, problem *p);

  // Rules that hold in every scenario unless it has its own.
  const gate_rule *rules;
  int rule_count;
} layer;

extern const layer layer_parameters, layer_instant, layer_linear, layer_traces, layer_invariants,
    layer_convergence, layer_horizon, layer_cost;

// All layers in order; NULL beyond the last.
const layer *layer_at(int index);
const layer *layer_find(const char *name);

// Whether any layer needs it.
bool layer_needs(const comparison *c, const trace_signal *signal, size_t row);

// True if `word` is one of a NULL-terminated list.
bool layer_names(const char *const *list, const char *word);

#endif
