// SPDX-License-Identifier: Apache-2.0
// A ride: the equations integrated in time with SUNDIALS, sampled exactly at the asked times.
#ifndef BICYCLE_RIDE_H
#define BICYCLE_RIDE_H

#include <bicycle/state.h>
#include <stddef.h>

typedef enum bike_method {
  BIKE_METHOD_RK8,  // adaptive Runge-Kutta of order 8 (ARKODE): the default
  BIKE_METHOD_ADAMS, // CVODE's Adams method of variable order
  BIKE_METHOD_RK4   // classical Runge-Kutta with a fixed step, for convergence studies
} bike_method;

typedef enum bike_event_kind {
  BIKE_EVENT_REAR_LIFT,   // normal force on the rear wheel falls to zero; the ride goes on
  BIKE_EVENT_FRONT_LIFT,  // the same at the front wheel
  BIKE_EVENT_LEAN_LIMIT,  // |lean| reaches the limit; ends the ride
  BIKE_EVENT_VALIDITY,    // the geometry or the dynamics become singular; ends the ride
  BIKE_EVENT_STANDSTILL   // the speed falls to zero; ends the ride
} bike_event_kind;

typedef struct bike_event {
  bike_event_kind kind;
  double time; // s
} bike_event;

BIKE_API const char *bike_event_string(bike_event_kind kind);

// One row of a ride: the columns of `bicycle ride`, in SI and radians, ISO signs.
typedef struct bike_sample {
  double time;
  double x, y, yaw;              // rear contact point and heading
  double lean, pitch, steer;     //
  double lean_rate, steer_rate;  //
  double speed;                  //
  double rear_angle, front_angle; // hinge angles, growing when rolling forward
  double energy;                 // kinetic + potential
  double rear_normal, front_normal;     // N
  double rear_friction, front_friction; // horizontal / normal force
} bike_sample;

// What is not in a CSV row but judged by the comparator.
typedef struct bike_sample_more {
  double work;            // J  done since the start by torques, damper and the rider's motion
  double rear_force[3];   // N  as in bike_snapshot
  double front_force[3];  // N
} bike_sample_more;

// Inputs as a function of time; `user` is the definition's.
typedef void bike_input_function(double time, bike_input *out, void *user);

// Called after each sample; a nonzero return stops the ride with BIKE_ERROR_INTERRUPTED.
typedef int bike_sample_function(const bike_sample *sample, const bike_sample_more *more,
                                 void *user);

typedef struct bike_ride_def {
  bike_state start;       //
  double duration;        // s      > 0; rows at k * sample, k = 0 .. round-down(duration/sample)
  double sample;          // s      > 0, <= duration
  bike_method method;     //
  double rtol, atol;      //        adaptive methods
  double step;            // s      fixed step of BIKE_METHOD_RK4; must divide `sample`
  double lean_limit;      // rad    0 < limit <= pi/2
  bool stop_at_lift;      //        a lift event ends the ride
  bike_input_function *input; //    NULL: no input
  const double *breakpoints;  // s  rising times at which the input is not smooth; may be NULL
  size_t breakpoint_count;    //
  bike_sample_function *on_sample; // required
  void *user;             //        for both functions
} bike_ride_def;

enum { BIKE_MAX_EVENTS = 64 };

typedef struct bike_ride_result {
  double end_time;        // s   reached
  bool complete;          //     the whole duration was ridden
  int event_count;        //     further events than BIKE_MAX_EVENTS are counted, not kept
  bike_event events[BIKE_MAX_EVENTS];
  long evaluations;       //     right-hand sides
  long steps;             //     accepted steps
} bike_ride_result;

// Default definition; fill in start, duration, sample and on_sample.
BIKE_API bike_ride_def bike_default_ride_def(void);

// Rides. 0 also when an event ended the ride early (see `complete`). Errors: those of
// bike_evaluate for the start state, ARGUMENT, SOLVER, INTERRUPTED, MEMORY; the result then holds
// what was reached.
BIKE_API int bike_ride(bike_ride_result *out, const bike_model *model, const bike_ride_def *def);

#endif
