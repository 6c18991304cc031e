// SPDX-License-Identifier: Apache-2.0
// A point of a map over speed and lean, as in figure 2(c): the stationary turn with its rider
// offset, the Jacobian at constant energy, its eigenvalues.
#ifndef BICYCLE_BENCH_POINT_H
#define BICYCLE_BENCH_POINT_H

#include <bicycle/turn.h>

// A row of a map at one speed; each point starts from its neighbour.
typedef struct bench_row {
  const bike_model *model;
  double speed;       // m/s
  double start, step; // rad  lean of the first point, and from one to the next
  bike_turn first;    //      the turn at `start`
  volatile double sink;
} bench_row;

// False where there is no such turn.
bool bench_row_begin(bench_row *row, const bike_model *model);

// `repeats` points, the library's way, and by finite differences with a general eigenvalue solver.
void bench_exact_points(void *row, long repeats);
void bench_difference_points(void *row, long repeats);

#endif
