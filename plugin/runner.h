// SPDX-License-Identifier: Apache-2.0
// Headless rides of a MuJoCo bicycle, measured in the terms of the analytic model.
//
// The bicycle is one made by bicycle_mjcf, or any model with the same names of bodies and joints.
// The start is made consistent with the six rolling constraints by MuJoCo's own kinematics: no
// analytic equation takes part in a ride, so that a comparison compares two independent engines.
// One runner serves one thread at a time; runners in different threads are independent. Those who
// create one wait for each other (bicycle_mjcf.h). What is process-global, the callbacks of MuJoCo
// and its handlers of errors, is set by the first and the same for all.
#ifndef BICYCLE_RUNNER_H
#define BICYCLE_RUNNER_H

#include "bicycle_mjcf.h"

#include <bicycle/ride.h>

// 0 or why a run failed, with its kind; details stand in mjcf_error.
#define RUNNER_STATUSES(X)                                                                         \
  X(RUNNER_OK, "no error")                                                                         \
  X(RUNNER_ARGUMENT, "an argument is outside its range")                                           \
  X(RUNNER_MODEL, "the model is not a bicycle the runner knows")                                   \
  X(RUNNER_UNSUPPORTED, "the rider of this MuJoCo bicycle cannot move")                            \
  X(RUNNER_START, "no start position satisfies the rolling constraints")                           \
  X(RUNNER_MEMORY, "out of memory")                                                                \
  X(RUNNER_INTERRUPTED, "interrupted by the caller")                                               \
  X(RUNNER_INVALID_ERROR, "MuJoCo raised an error")                                                \
  X(RUNNER_INVALID_WARNING, "MuJoCo raised a warning")                                             \
  X(RUNNER_INVALID_TIME, "MuJoCo's time did not grow by one timestep: the state was reset")        \
  X(RUNNER_INVALID_CALLBACK, "mjcb_control is no longer that of exact rolling")                    \
  X(RUNNER_INVALID_NOT_FINITE, "the state is not finite")                                          \
  X(RUNNER_INVALID_INTEGRATOR, "the integrator failed")

typedef enum runner_status {
#define RUNNER_STATUS_CODE(code, text) code,
  RUNNER_STATUSES(RUNNER_STATUS_CODE)
#undef RUNNER_STATUS_CODE
} runner_status;

// The text of a status; never NULL.
const char *runner_status_string(runner_status status);

// The exit code of design.md: 0, 2 (usage or input) or 3 (the run is invalid).
int runner_exit_code(runner_status status);

typedef struct runner runner;

// A runner for a bicycle, or for a model file (.xml, .mjb) of one. NULL with a text in `error`,
// and why in `status` (either may not be NULL), RUNNER_MODEL also where MuJoCo's mass matrix is
// singular without the ground. Free with runner_free; NULL is allowed there.
runner *runner_create(const bike_bicycle *bicycle, const mjcf_options *options,
                      runner_status *status, mjcf_error *error);
runner *runner_load(const char *path, runner_status *status, mjcf_error *error);
void runner_free(runner *r);

// A runner for anybody's model of a bicycle (bicycle_import.h), its wheels made to roll exactly.
// Its integrator and timestep are those of the file until changed.
runner *runner_import(const char *path, runner_status *status, mjcf_error *error);

// The same model as it is: on its own contacts, whatever they are. RUNNER_MODEL for one whose
// wheels a marker makes to roll.
runner *runner_import_as_is(const char *path, runner_status *status, mjcf_error *error);

// Puts the runner's control callback and, after it, exact rolling into MuJoCo, as the first runner
// does: for who steps a model of his own beside runners. Again: no effect. Any thread.
void runner_install_control(void);

// The compiled model, to be read (Lp tests) or, between rides, changed in integrator, timestep.
mjModel *runner_model(runner *r);

// Whether an input may move the rider: the model was made with mjcf_options.moving_rider.
bool runner_rider_moves(const runner *r);

// The state from which mj_step continues, for tests and tools; valid until runner_free.
mjData *runner_data(runner *r);

// Where the newest instant was evaluated, sensors included; valid until runner_free.
const mjData *runner_measured(const runner *r);

// What MuJoCo says of one instant. Index 0: rear, 1: front wheel. Forces of the ground on the
// wheel along (e_R of the rear wheel, horizontal left of it, up), N.
typedef struct runner_instant {
  double x, y;                                        // m      rear contact point
  double yaw, lean, pitch;                            // rad    yaw is continuous during a ride
  double steer;                                       // rad
  double yaw_rate, lean_rate, pitch_rate, steer_rate; // rad/s
  double speed;          // m/s    of the rear contact point along its track
  double wheel_angle[2]; // rad    hinges, rolling forward positive
  double wheel_rate[2];  // rad/s
  double yaw_acceleration, lean_acceleration, pitch_acceleration, steer_acceleration; // rad/s^2
  double speed_rate;                                                                  // m/s^2
  double wheel_acceleration[2];                                                       // rad/s^2
  double kinetic, potential; // J      zero potential with every mass at the ground
  double power;              // W      of steer torque, roll torque, damper and moving rider
  double force[2][3];        // N
  double slip[2];            // m/s    horizontal speed of the wheel's material at its contact
  double height[2];          // m      of the lowest point of the disc above the ground
  double height_rate[2];     // m/s
} runner_instant;

// The instant at a state: x = y = yaw = wheel angles = 0. `input` may be NULL: hands off. Does not
// touch a ride's state. Errors: ARGUMENT, UNSUPPORTED, START, INVALID_*.
runner_status runner_evaluate(runner_instant *out, runner *r, const bike_state *state,
                              const bike_input *input, mjcf_error *error);

// Whether a stop acted at the newest instant: a limited joint or tendon at an end of its range,
// where the bicycle is no longer that of the equations.
bool runner_at_stop(const runner *r);

// MuJoCo's mass matrix for the speeds (lean_rate, steer_rate, speed) of the rolling bicycle:
// V^T M V, the columns of V being the velocities (qvel) at one unit of each. Row-major, SI, as
// bike_mass_matrix; of the state only lean and steer matter. Does not touch a ride's state.
// Errors: ARGUMENT, START, MEMORY, INVALID_ERROR.
runner_status runner_mass_matrix(double out[9], runner *r, const bike_state *state,
                                 mjcf_error *error);

// Places the ride's state (time 0) at a bike_state, or at the model's keyframe `test`
// (RUNNER_MODEL if there is none). The keyframe's state is taken as it is if its constraint
// residuals are below RUNNER_START_TOLERANCE, and refused otherwise.
runner_status runner_start(runner *r, const bike_state *state, mjcf_error *error);
runner_status runner_start_at_keyframe(runner *r, mjcf_error *error);

// Residual allowed at the start, of heights relative to max(1 m, wheel radius), of velocities to
// max(1 m/s, the largest of the terms that make them up): |v| + |omega| arm of a wheel, which is
// twice the speed in a straight ride and more where a bicycle turns on the spot. It is some hundred
// roundings of those, and a thousandth of what a ride of 10 s at 1 ms accumulates.
#define RUNNER_START_TOLERANCE 1e-13

// The instant at which the ride is. Errors: INVALID_*.
runner_status runner_measure(runner_instant *out, runner *r, mjcf_error *error);

// A row of a ride and what the comparator judges beside it.
typedef struct runner_sample {
  bike_sample row;       // the columns of `bicycle ride`
  bike_sample_more more; // work and forces
  double slip[2];        // as in runner_instant
  double height[2];      //
  double height_rate[2]; //
} runner_sample;

// A nonzero return stops the ride with RUNNER_INTERRUPTED.
typedef int runner_sample_function(const runner_sample *sample, void *user);

typedef struct runner_ride_def {
  double duration;            // s    > 0, a multiple of the timestep; rows at k * sample
  double sample;              // s    a multiple of the timestep
  double lean_limit;          // rad  0 < limit < pi/2
  bool stop_at_lift;          //      a lift event ends the ride
  double friction_limit;      //      as in bike_ride_def; 0: any horizontal force is too much
  double tolerance;           //      0: MuJoCo's own integrator. > 0: SUNDIALS' CVODE around
                              //      mj_forward instead, with this relative and absolute
                              //      tolerance; the timestep then is that of the output
  bike_input_function *input; //      NULL: hands off; evaluated at every stage of a step
  runner_sample_function *on_sample; //      required
  void *user;                        //      for both functions
} runner_ride_def;

// 10 s in rows of 10 ms, the lean and friction limits of bike_default_ride_def.
runner_ride_def runner_default_ride_def(void);

// Whether runner_ride would take the definition: RUNNER_OK or RUNNER_ARGUMENT.
runner_status runner_check_ride(const runner *r, const runner_ride_def *def, mjcf_error *error);

typedef struct runner_ride_result {
  double end_time;                    // s    reached: the duration, or the event that ended it
  bool complete;                      //      the whole duration was ridden
  bike_sample end;                    //      at end_time, interpolated like the event; meaningful
                                      //      with RUNNER_OK
  int event_count;                    //      further events than BIKE_MAX_EVENTS are not kept, but
                                      //      the one that ends the ride takes the last place
  bike_event events[BIKE_MAX_EVENTS]; //      in order; what holds at the start at exactly 0, the
                                      //      others to linear interpolation within a step. Those
                                      //      of bicycle/ride.h, but there is no
                                      //      BIKE_EVENT_VALIDITY: MuJoCo rides on where the
                                      //      coordinates of the equations end
  bike_wheel_ground ground[2];        //      looked at after every step; intervals to linear
                                      //      interpolation within one
  long steps;                         //      of the integrator
  long evaluations;                   //      of mj_forward by the integrator
  double wall_time;                   // s    spent in mj_step or CVODE alone
} runner_ride_result;

// Rides from the state where runner_start left it, and samples. After every step: no warning, time
// grew by one timestep, mjcb_control still ours, state finite; otherwise INVALID_*, with the time
// in `error`. RUNNER_OK also when an event ended the ride early.
runner_status runner_ride(runner_ride_result *out, runner *r, const runner_ride_def *def,
                          mjcf_error *error);

#endif
