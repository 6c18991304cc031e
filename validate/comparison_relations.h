// SPDX-License-Identifier: Apache-2.0
// Exact relations between two rides: a signal with the other sign, in another unit, or in another
// signal's column.
#ifndef VALIDATE_COMPARISON_RELATIONS_H
#define VALIDATE_COMPARISON_RELATIONS_H

#include "comparison.h"

// candidate's `signal` = factor times reference's `of`, but for what is left.
typedef struct relation {
  const trace_signal *signal, *of;
  double factor;
  double left; // largest |candidate/factor - reference|, in the unit of `of`
} relation;

// Finds the relations of the signals of motion that differ, one per signal at most, and returns
// their number. A relation holds if it leaves a root mean square of at most 2 % of the reference's:
// a sign or a unit is seen although something else is slightly wrong too, and `left` says how much.
int relations_find(relation out[TRACE_MOTION_COUNT], const comparison *c);

// Appends them to the cause, those of a kind together.
void relations_say(comparison *c, const relation *relations, int count);

#endif
