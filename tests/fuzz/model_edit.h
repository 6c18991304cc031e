// SPDX-License-Identifier: Apache-2.0
// Changes of a compiled MuJoCo model that keep it one.
#ifndef TESTS_FUZZ_MODEL_EDIT_H
#define TESTS_FUZZ_MODEL_EDIT_H

#include "fuzz.h"

#include <mujoco/mujoco.h>

// Makes one change: a number, a type or a flag. False if MuJoCo itself would not have compiled such
// a model, so that its own equations need not be sound: numbers that are not finite, or huge.
bool model_edit(mjModel *m, fuzz_bytes *bytes);

#endif
