// SPDX-License-Identifier: Apache-2.0
// What scipy_peer.py finds in the shared library.
#ifndef BICYCLE_BENCH_SYMPY_FLOW_H
#define BICYCLE_BENCH_SYMPY_FLOW_H

#include "sympy_bicycle.h"

#include <bicycle/export.h>

// The bicycle: a sympy_bicycle as an array. -1 where the count is not that of its members.
BIKE_API int sympy_flow_load(const double *parameters, int count);

// Rates of y, with the faster of sympy's systems; NaN where there are none.
BIKE_API void sympy_flow(const int *n, const double *t, const double *y, double *dy);

// Calls since the last time this was asked.
BIKE_API long sympy_flow_calls(void);

// Many evaluations near y, to time one.
BIKE_API void sympy_flow_repeat(const double *y, double *dy, long repeats);

#endif
