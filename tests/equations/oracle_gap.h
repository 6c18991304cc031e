// SPDX-License-Identifier: Apache-2.0
// How far the library is from the nine equations: the worst over many states, each measure with
// the limit that the tests hold it to.
#ifndef BICYCLE_TESTS_ORACLE_GAP_H
#define BICYCLE_TESTS_ORACLE_GAP_H

#include <bicycle/state.h>

typedef struct oracle_gap {
  int states;          // compared
  int no_geometry;     // refused by the library and by the oracle
  double acceleration; // of max(1, largest of phi'', kappa'', v')
  double geometry;     // of max(1, |value|): (1)-(7) and what has no accelerations in it
  double rotation;     // as `acceleration`: of yaw, pitch and both wheels
  double force;        // of the total weight
  double energy;       // kinetic and potential, of the kinetic energy plus weight times one metre
  double power;        // of the sum of the sizes of its terms
  double equation_23;  // residual of corrected (23) at the library's accelerations
} oracle_gap;

// Adds one state. Fails the running test where only one of the two finds no geometry.
void oracle_gap_add(oracle_gap *gap, const bike_bicycle *bicycle, const bike_model *model,
                    const bike_state *state, const bike_input *input);

// Prints the measures and fails the running test where one is above its limit.
void oracle_gap_judge(const oracle_gap *gap, const char *name);

#endif
