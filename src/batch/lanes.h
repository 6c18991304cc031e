// SPDX-License-Identifier: Apache-2.0
// Several bicycles in the lanes of vector registers: what is compiled once for each instruction
// set, behind one const struct.
#ifndef BICYCLE_BATCH_LANES_H
#define BICYCLE_BATCH_LANES_H

#include <bicycle/state.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// No instruction set has more; blocks below have room for so many.
enum { LANES_MOST = 8 };

// So many blocks at a time: a bit for each state.
enum { LANES_BLOCKS = 64 / LANES_MOST };

// Bicycles packed for the lanes, of `block_size` bytes, aligned to 64.
typedef struct lanes_models lanes_models;

// Values of a block: for each quantity an array of one number a lane.
enum { LANES_LEAN, LANES_STEER, LANES_LEAN_RATE, LANES_STEER_RATE, LANES_SPEED, LANES_STATE };
enum { LANES_LEAN_ACC, LANES_STEER_ACC, LANES_SPEED_RATE, LANES_ACCELERATIONS };

// One ride of many, as it comes into a lane.
typedef struct lanes_rider {
  size_t member;                       // the caller's number
  const bike_model *model;             //
  bike_state state;                    //
  double rear_angle[2];                // sin, cos of beta_r there
  double side;                         // sign of the yaw rate's denominator (13) there
  double w, steer_torque, roll_torque; // constant inputs
} lanes_rider;

typedef enum lanes_end {
  LANES_COMPLETE,   // the duration is over
  LANES_SETTLED,    // rides straight
  LANES_LEAN_LIMIT, // and so on: as of bike_ride
  LANES_VALIDITY,
  LANES_STANDSTILL,
  LANES_UNDECIDED // no step from `state` on is accurate: the lanes cannot tell why
} lanes_end;

// What became of it.
typedef struct lanes_ended {
  size_t member;
  lanes_end end;
  double time;      // s  of `state`
  bike_state state; //
  bool lifted;      // a wheel was off the ground at the end of some step
  long steps;       // accepted
  long evaluations; // right-hand sides of this lane
} lanes_ended;

typedef struct lanes_ride_def {
  double duration, rtol, atol, lean_limit;
  double look;       // s    riding straight is looked for so often; 0: never
  int looks_settled; //      in a row
  bool watch_lift;   //
  // Whether a member rides straight at the moment; and, once it has done so for all of these looks,
  // whether that ends its ride: if not, they are counted anew.
  bool (*quiet)(size_t member, const bike_state *state, void *user);
  bool (*settled)(size_t member, const bike_state *state, void *user);
  bool (*next)(lanes_rider *out, void *user); // false: no more
  void (*done)(const lanes_ended *end, void *user);
  void *user;
} lanes_ride_def;

typedef struct lanes_functions {
  int width;
  size_t block_size;
  // Puts a bicycle into one lane of a block.
  void (*pack)(lanes_models *block, const bike_model *model, int lane);
  // Accelerations of up to LANES_BLOCKS blocks of states, hands off, of as many blocks of bicycles
  // or, if they are the same, of one. Bit i of the result: state i has been solved; the others'
  // results are undefined: their rear angle is too far from the guess near upright, or they have no
  // geometry.
  uint64_t (*accelerate)(double *const out[LANES_ACCELERATIONS], const lanes_models *models,
                         bool same, const double *const state[LANES_STATE], int blocks);
  // Stationary motion, hands off: steer and rider offset go in as guesses. Bit i: lane i has come
  // to an end of Newton's method; whether near its guess is the caller's to judge.
  unsigned (*turn)(double *steer, double *offset, const lanes_models *block, const double *speed,
                   const double *lean);
  // Eigenvalues of q'' = C q' + K q, in [entry * width + lane]: entries of K and C are row-major;
  // re and im have four, in no order, and conjugate to rounding only. Bit i: lane i is done.
  unsigned (*eigenvalues)(double *re, double *im, const double *K, const double *C);
  // Rides all that `next` gives, each with its own steps: what becomes of one does not depend on
  // its neighbours.
  void (*ride)(const lanes_ride_def *def);
} lanes_functions;

extern const lanes_functions lanes_baseline, lanes_v3, lanes_v4;

const lanes_functions *lanes_in_use(void);

#endif
