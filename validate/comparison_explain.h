// SPDX-License-Identifier: Apache-2.0
// Why a comparison fails, in one sentence.
#ifndef VALIDATE_COMPARISON_EXPLAIN_H
#define VALIDATE_COMPARISON_EXPLAIN_H

#include "comparison.h"

// Fills first_failure and cause from the gates of a layer that fail; `worst` is the one that uses
// up its limit most.
void comparison_explain(comparison *c, const gate *worst);

#endif
