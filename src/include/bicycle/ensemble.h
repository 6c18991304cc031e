// SPDX-License-Identifier: Apache-2.0
// Many rides at once: of many bicycles, from many starts. For basins of attraction, uncertainty,
// design sweeps: what becomes of each ride is wanted, not its trace.
//
// Rides go in the lanes of vector registers and over threads, with the Runge-Kutta pair of order
// 8(7) of bike_ride. Each has its own steps: a result depends on its member alone, to the last bit,
// whatever the neighbours, their order and the number of threads.
#ifndef BICYCLE_ENSEMBLE_H
#define BICYCLE_ENSEMBLE_H

#include <bicycle/ride.h>

// One ride. The inputs are constant: the rider's velocity and acceleration must be zero.
typedef struct bike_member {
  const bike_model *model;
  bike_state start;
  bike_input input;
  bool circles; // may settle to a circle: its rates alone must be small
} bike_member;

typedef enum bike_outcome {
  BIKE_OUTCOME_COMPLETE,   // still rides when the time is over
  BIKE_OUTCOME_SETTLED,    // rides straight
  BIKE_OUTCOME_LEAN_LIMIT, // has fallen
  BIKE_OUTCOME_VALIDITY, // the model ends, as of bike_ride, but beyond some 150 deg of steer, where
                         // lanes may find the rear angle a little longer
  BIKE_OUTCOME_STANDSTILL, // the speed crosses zero
  BIKE_OUTCOME_ERROR,      // see `error`
  BIKE_OUTCOMES
} bike_outcome;

BIKE_API const char *bike_outcome_string(bike_outcome outcome); // "complete", "settled", ...

typedef struct bike_member_result {
  bike_outcome outcome;
  int error;        //    of bike_ride, for instance of a start that has no geometry; else 0
  double time;      // s  when it was decided
  bike_state end;   //    then
  bool lifted;      //    a wheel was pulled on (< 0) at the end of some step; false if not watched
  long steps;       //    accepted
  long evaluations; //    right-hand sides
} bike_member_result;

typedef struct bike_ensemble_def {
  double duration;   // s    > 0
  double rtol, atol; //      per step, as of bike_ride
  double lean_limit; // rad  0 < limit <= pi/2
  double settled;    // rad  a ride is straight once lean, steer and their rates (rad/s) have stayed
                     //      below this for a second; 0: never
  // Whether a motion to which a member has settled ends its ride; NULL: always. If not, the second
  // begins anew. Called from any of the threads.
  bool (*judge)(const bike_member *member, const bike_state *state, void *user);
  void *judge_user;
  bool watch_lift; //
  bool plain;      //      one after the other by bike_ride, for checks: the same within the
                   //      tolerances
  int threads;     //      >= 1
  void (*progress)(double done, void *user); // may be NULL; called by the calling thread alone,
                                             //      with rising numbers, 1 at the end
  void *user;
} bike_ensemble_def;

// 60 s at rtol 1e-10 and atol 1e-12, lean limit 80 degrees, settled at 0.005 rad, lifts watched,
// one thread.
BIKE_API bike_ensemble_def bike_default_ensemble_def(void);

// out[i] for members[i]. Errors: ARGUMENT (a definition outside its range, a rider that moves),
// MEMORY. What goes wrong with a member is told in its result.
BIKE_API int bike_ensemble_ride(bike_member_result *out, const bike_member *members, size_t count,
                                const bike_ensemble_def *def);

#endif
