// SPDX-License-Identifier: Apache-2.0
// Linearisation of any engine that can evaluate an instant.
#ifndef VALIDATE_ENGINE_DIFFERENCES_H
#define VALIDATE_ENGINE_DIFFERENCES_H

#include "engine.h"

// The A of engine.h, by central differences of order 8 of the engine's accelerations.
term_exit engine_differences(double A[16], const engine *e, void *instance, double speed,
                             problem *p);

#endif
