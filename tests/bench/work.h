// SPDX-License-Identifier: Apache-2.0
// Pieces of work that more than one group of contests times.
#ifndef BICYCLE_BENCH_WORK_H
#define BICYCLE_BENCH_WORK_H

#include "list.h"
#include "twin.h"

// One right-hand side with bike_rates_of of the library as its users get it; `subject` is
// a bench_subject.
void bench_right_hand_sides(void *subject, long repeats);

// The accelerations alone, with the instance of our equations built for this machine (native.h).
void bench_native_accelerations(void *subject, long repeats);

// mj_forward without callback, sensors and contacts: what MuJoCo needs for the accelerations alone.
// `twin` is a bench_twin.
void bench_mujoco_forward(void *twin, long repeats);

#endif
