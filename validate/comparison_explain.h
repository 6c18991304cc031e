// SPDX-License-Identifier: Apache-2.0
// Why a comparison fails, in one sentence. It asserts only what a layer measured.
#ifndef VALIDATE_COMPARISON_EXPLAIN_H
#define VALIDATE_COMPARISON_EXPLAIN_H

#include "comparison.h"

// Fills first_failure and cause from the gates of a layer that fail; `worst` is the one that uses
// up its limit most.
void comparison_explain(comparison *c, const gate *worst);

// The same of L2; comparison_explain calls it.
void comparison_explain_traces(comparison *c, const gate *worst);

//---------------------------------- the sentence --------------------------------------------------

// Appends to the cause.
void comparison_say(comparison *c, const char *format, ...) __attribute__((format(printf, 2, 3)));

// "the parameters agree, but ": of the layers before the first failure, the last with a gate.
void comparison_say_agreed(comparison *c);

// "max 1.2e-5 rad, limit 1e-11, at 0.3 s"
void comparison_say_limit(comparison *c, const gate *worst);

// What the convergence study (L4) found, where it did not find the same equations.
void comparison_say_order(comparison *c);

// Whether a layer has a gate that judges more than how the rides end.
bool comparison_is_gated(const comparison *c, const struct layer *l);

// "front_frame_Ixz" as a person writes it.
typedef struct comparison_text {
  char text[MEASUREMENT_NAME];
} comparison_text;
comparison_text comparison_words(const char *signal);

// "analytic", "the recording", "the candidate".
const char *comparison_name(const comparison *c, int side);

#endif
