// SPDX-License-Identifier: Apache-2.0
// A point of a map over speed and lean, as in figure 2(c): the stationary turn with its rider
// offset, the Jacobian at constant energy, its eigenvalues.
#ifndef BICYCLE_BENCH_POINT_H
#define BICYCLE_BENCH_POINT_H

#include <bicycle/map.h>
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

// Lean of the row's i-th point.
double bench_row_lean(const bench_row *row, long i);

// `repeats` points by bike_turn_near, and by finite differences with a general eigenvalue solver.
void bench_exact_points(void *row, long repeats);
void bench_difference_points(void *row, long repeats);

// One point by finite differences, from its neighbour; 0 or an error of the library.
int bench_difference_point(bike_map_node *out, const bench_row *row, double lean,
                           const bike_map_node *from);

// How far both are from bike_map_turns along the row: steer (rad), rider offset (m), eps_max (1/s).
// Infinite where one has no answer.
double bench_row_disagreement(const bench_row *row);

// The matrix of bike_linearize by central differences of accelerations and energy.
int bench_differences(double A[16], const bike_model *model, const bike_state *state,
                      double rider_offset);

#endif
