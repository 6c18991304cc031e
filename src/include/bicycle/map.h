// SPDX-License-Identifier: Apache-2.0
// Stationary motion and its stability over a grid of speed and lean: the paper's figure 2.
//
// Source: section 4 of Franke, Suhr, Riess (1990). Each node has the steer and the rider's offset
// with which the bicycle rides its circle hands off, and the eigenvalues about it. Computed in the
// lanes of vector registers and over threads; the same as bike_turn_near to rounding.
#ifndef BICYCLE_MAP_H
#define BICYCLE_MAP_H

#include <bicycle/stability.h>
#include <stddef.h>

typedef struct bike_map_node {
  double steer;                 // rad
  double rider_offset;          // m
  double eps_max;               // 1/s  largest real part of an eigenvalue; < 0: self-stable
  bike_eigenvalues eigenvalues; //  at constant energy
  int error;                    //  0, or why there is no such motion; all else is NaN then
} bike_map_node;

typedef struct bike_map_def {
  const double *speeds; // m/s  rising
  const double *leans;  // rad  rising from 0, or close to it, in steps small enough to follow
  size_t speed_count, lean_count;
  int threads;                               // >= 1
  bool plain;                                // node by node with bike_turn_near, for checks
  void (*progress)(double done, void *user); // may be NULL; called by the calling thread alone
  void *user;
} bike_map_def;

// out[j * speed_count + i] at (speeds[i], leans[j]): of several motions the one that is reached
// from upright riding by leaning over at constant speed or, where this is cut off, by slowing down
// at constant lean. Errors: ARGUMENT, NO_RIDER, MEMORY.
BIKE_API int bike_map_turns(bike_map_node *out, const bike_model *model, const bike_map_def *def);

#endif
