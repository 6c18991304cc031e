// SPDX-License-Identifier: Apache-2.0
// The static pictures of a scenario.
#ifndef VALIDATE_REPORT_CURVES_H
#define VALIDATE_REPORT_CURVES_H

#include "comparison.h"

#include <jansson.h>

// Traces, residuals, energy, constraints: needs rows of both engines. False when out of memory.
bool report_curves(FILE *stream, const comparison *c, const json_t *entry);

// Error over step size from the scenario's blocks "convergence", error over cost from "cost", in
// right-hand sides and in seconds of a processor; nothing for a block that is not there.
void report_curves_convergence(FILE *stream, const json_t *entry);
void report_curves_cost(FILE *stream, const comparison *c, const json_t *entry);

#endif
