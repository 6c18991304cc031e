// SPDX-License-Identifier: Apache-2.0
// How far an unstable ride can be predicted by anyone who computes with double numbers.
#ifndef VALIDATE_HORIZON_H
#define VALIDATE_HORIZON_H

#include "comparison.h"

// Rides twins of the reference and fills c->study.horizon; the reference must have been ridden.
term_exit horizon_find(comparison *c, problem *p);

#endif
