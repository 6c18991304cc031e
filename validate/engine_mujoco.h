// SPDX-License-Identifier: Apache-2.0
// What tests need of the MuJoCo engine beyond engine.h.
#ifndef VALIDATE_ENGINE_MUJOCO_H
#define VALIDATE_ENGINE_MUJOCO_H

#include "engine.h"

#include <runner.h>

// The runner at work, to be perturbed.
runner *engine_mujoco_runner(void *instance);

// The bicycle that a compiled model holds, four parts: from masses, centres and tensors of its
// bodies, the marker of the rolling discs, the axis of the joint `steer` and its damping.
term_exit engine_mujoco_read_back(bike_bicycle *out, const mjModel *model, problem *p);

#endif
