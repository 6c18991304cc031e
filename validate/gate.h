// SPDX-License-Identifier: Apache-2.0
// Gates: measurements held against the limits of a scenario.
#ifndef VALIDATE_GATE_H
#define VALIDATE_GATE_H

#include "scenario.h"

// A measurement with the rule that judges it.
typedef struct gate {
  measurement what;
  const gate_rule *rule; // of the scenario or of a layer
  bool pass;             // value <= limit; a NaN does not pass
} gate;

typedef struct gate_list {
  gate *items;
  size_t count;
} gate_list;

// Judges every measurement for which there is a rule. A rule of the scenario for something that
// was not measured, of a layer in `measured_layers`, becomes a gate that fails. False when out of
// memory; clear the list in any case.
bool gates_judge(gate_list *out, const measurement_list *measurements, const gate_rules *rules,
                 int measured_layers);

// Whether a rule is about that layer, metric and signal, in whatever part of the ride.
bool gate_rule_names(const gate_rule *rule, const measurement *m);

// The rule of a measurement, by which it is judged or said to be information: the last fitting one
// of the scenario, else its layer's own; NULL: it is not judged.
const gate_rule *gate_rule_for(const measurement *m, const gate_rules *rules);

void gates_clear(gate_list *list);

// How much of its limit a gate uses up: value/limit; infinite for one that fails with NaN or
// against a limit of zero.
double gate_use(const gate *g);

// Pointers to the gates, failures first, then by falling use; free it. NULL when out of memory.
const gate **gates_by_margin(const gate_list *list);

size_t gates_failed(const gate_list *list);

#endif
