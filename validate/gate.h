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

// Whether a row at that time belongs to the part of a ride from `from` to `to`, s, both included;
// to 0: the end. Rows are at k sample, which is not to the last digit what people write: a
// millionth of a sample is no difference.
bool gate_covers(double from, double to, double time, double sample);

// Whether a rule is about that layer, metric and signal, in whatever part of the ride.
bool gate_rule_names(const gate_rule *rule, const measurement *m);

// The rule of a measurement, by which it is judged or said to be information: the last fitting one
// of the scenario, else its layer's own; NULL: it is not judged.
const gate_rule *gate_rule_for(const measurement *m, const gate_rules *rules);

// Whether that rule, one of `rules`, judges a signal of L2 by the metric 'max', in whatever part of
// the ride.
bool gate_limits_max(const gate_rule *rule, const gate_rules *rules, const char *signal);

void gates_clear(gate_list *list);

// How much of its limit a gate uses up: value/limit; infinite for one that fails with NaN or
// against a limit of zero.
double gate_use(const gate *g);

#endif
