// SPDX-License-Identifier: Apache-2.0
// What the layers found out beyond single numbers, in report.json.
#ifndef VALIDATE_REPORT_JSON_LAYERS_H
#define VALIDATE_REPORT_JSON_LAYERS_H

#include "comparison.h"

#include <jansson.h>

// Adds `linear`, `convergence`, `horizon` and `cost` to a scenario's object, each where the
// scenario asks for it.
void report_add_layers(json_t *object, const comparison *c);

// Adds the seconds that belong to `convergence` and `cost`, in the order of their points.
void report_add_timings(json_t *ride, const comparison *c);

#endif
