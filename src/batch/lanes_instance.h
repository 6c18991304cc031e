// SPDX-License-Identifier: Apache-2.0
// The functions of one instance, before they stand in its struct.
#ifndef BICYCLE_BATCH_LANES_INSTANCE_H
#define BICYCLE_BATCH_LANES_INSTANCE_H

#include "batch/lanes.h"
#include "equations/instruction_set.h"

void INSTANCE(lanes_pack)(lanes_models *block, const bike_model *model, int lane);
uint64_t INSTANCE(lanes_accelerate)(double *const out[LANES_ACCELERATIONS],
                                    const lanes_models *models, bool same,
                                    const double *const state[LANES_STATE], int blocks);
unsigned INSTANCE(lanes_turn)(double *steer, double *offset, const lanes_models *block,
                              const double *speed, const double *lean);
unsigned INSTANCE(lanes_eigenvalues)(double *re, double *im, const double *K, const double *C);
void INSTANCE(lanes_ride)(const lanes_ride_def *def);

#endif
