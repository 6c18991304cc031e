// SPDX-License-Identifier: Apache-2.0
// A ride: the equations integrated in time with SUNDIALS, sampled exactly at the asked times.
#ifndef BICYCLE_RIDE_H
#define BICYCLE_RIDE_H

#include <bicycle/ground.h>
#include <bicycle/state.h>
#include <stddef.h>

typedef enum bike_method {
  BIKE_METHOD_RK8,   // adaptive Runge-Kutta of order 8 (ARKODE): the default
  BIKE_METHOD_ADAMS, // CVODE's Adams method of variable order
  BIKE_METHOD_RK4    // classical Runge-Kutta with a fixed step, for convergence studies
} bike_method;

// Events are found at the ends of steps and at samples, then located to 1e-12 s. What is true at
// the start, or becomes true by a jump of the input, has that very time. What begins and ends
// within one step is not seen; a wheel that comes down again is no event.
typedef enum bike_event_kind {
  BIKE_EVENT_REAR_LIFT,  // normal force on the rear wheel falls to zero; the ride goes on
  BIKE_EVENT_FRONT_LIFT, // the same at the front wheel
  BIKE_EVENT_LEAN_LIMIT, // |lean| reaches the limit; ends the ride
  BIKE_EVENT_VALIDITY,   // the model ends: a denominator, T_r cos(phi~) - T_f of (13) or
                         // T_r - T_f cos(phi~) of (4) differentiated, has fallen to BIKE_EDGE of
                         // |T_r| + |T_f|, or the equations have no answer; ends the ride
  BIKE_EVENT_STANDSTILL  // the speed crosses zero; ends the ride. A ride that starts at speed
                         // zero has no such event: its wheels roll to and fro while it falls
} bike_event_kind;

// The share of |T_r| + |T_f| at which the model ends; src/motion/ride_event.c says why.
#define BIKE_EDGE 1e-3

typedef struct bike_event {
  bike_event_kind kind;
  double time; // s
} bike_event;

BIKE_API const char *bike_event_string(bike_event_kind kind);

// One row of a ride: the columns of `bicycle ride`, in SI and radians, ISO signs.
typedef struct bike_sample {
  double time;
  double x, y, yaw;                     // rear contact point and heading
  double lean, pitch, steer;            //
  double lean_rate, steer_rate;         //
  double speed;                         //
  double rear_angle, front_angle;       // hinge angles, growing when rolling forward
  double energy;                        // kinetic + potential
  double rear_normal, front_normal;     // N
  double rear_friction, front_friction; // bike_friction of the two forces
} bike_sample;

// What is not in a CSV row but judged by the comparator.
typedef struct bike_sample_more {
  double work;           // J  done since the start by torques, damper and the rider's motion
  double rear_force[3];  // N  as in bike_snapshot
  double front_force[3]; // N
} bike_sample_more;

// Inputs as a function of time; `user` is the definition's. `out` comes with all members zero. It
// is asked within 0 .. duration only, in no order; where it jumps it gives what holds from there
// on.
typedef void bike_input_function(double time, bike_input *out, void *user);

// Called at each sample, at a jump with the values after it; a nonzero return stops the ride with
// BIKE_ERROR_INTERRUPTED.
typedef int bike_sample_function(const bike_sample *sample, const bike_sample_more *more,
                                 void *user);

typedef struct bike_ride_def {
  bike_state start;      //
  double duration;       // s      > 0; rows at k * sample, k = 0 .. round-down(duration/sample)
  double sample;         // s      > 0, duration/1e9 <= sample <= duration
  bike_method method;    //
  double rtol, atol;     //        adaptive methods, per step: rtol >= 4 units of rounding, atol > 0
  double step;           // s      fixed step of BIKE_METHOD_RK4; must divide `sample`
  double lean_limit;     // rad    0 < limit <= pi/2
  bool stop_at_lift;     //        a lift event ends the ride
  double friction_limit; //     > 0: coefficient beyond which a wheel would slide; the ride goes on
  bike_input_function *input;      // NULL: no input
  const double *breakpoints;       // s  rising times at which the input is not smooth; may be NULL.
                                   //    Those outside the ride mean nothing
  size_t breakpoint_count;         //
  bike_sample_function *on_sample; // required
  void *user;                      //    for both functions
} bike_ride_def;

enum { BIKE_MAX_EVENTS = 64 };

typedef struct bike_ride_result {
  double end_time; // s   reached
  bool complete;   //     the whole duration was ridden
  bike_sample end; //     at end_time, be it a row or not; where the equations have no answer there,
                   //     and after an error: the last row
  int event_count; //     further events than BIKE_MAX_EVENTS are counted, not kept
  bike_event events[BIKE_MAX_EVENTS];
  bike_wheel_ground ground[2]; //  of the rear and the front wheel, looked at where events are;
                               //  intervals are located as events are
  long evaluations;            //     right-hand sides
  long steps;                  //     accepted steps
} bike_ride_result;

// Default definition; fill in start, duration, sample and on_sample. RK8 at 1e-13 (energy drifts by
// 1e-15 a second, traces err by 1e-14), step 1 ms, lean limit 80 degrees, friction limit 1.
BIKE_API bike_ride_def bike_default_ride_def(void);

// The first rule above that a definition breaks, in words: "rtol must be ..."; NULL: none. Of the
// start state nothing is asked here.
BIKE_API const char *bike_ride_broken_rule(const bike_ride_def *def);

// Rides. 0 also when an event ended the ride early (see `complete`). Errors: ARGUMENT for a
// definition that breaks a rule above; those of bike_evaluate for the start state; NOT_FINITE,
// NO_RIDER for an input on the way; SOLVER where no step is accurate enough; INTERRUPTED; MEMORY.
// The result then holds what was reached. Prints nothing; may be called from several threads.
BIKE_API int bike_ride(bike_ride_result *out, const bike_model *model, const bike_ride_def *def);

#endif
