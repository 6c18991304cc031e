// SPDX-License-Identifier: Apache-2.0
// What the files of the runner share; not for users.
#ifndef RUNNER_INTERNAL_H
#define RUNNER_INTERNAL_H

#include "bicycle_import.h"
#include "rolling.h"
#include "runner.h"

enum { RUNNER_REAR, RUNNER_FRONT, RUNNER_WHEELS };

typedef struct runner_hinge {
  int joint;   // id
  int qpos;    // address
  int dof;     // address
  int sign;    // 1, or -1 where it grows against this project's sense
  double zero; // rad  of qpos where the bicycle is straight
} runner_hinge;

typedef struct runner_wheel {
  int body;           // id
  runner_hinge hinge; // axle
  double hub[3];      // m  in the axes of the body
  double radius;      // m
} runner_wheel;

// A rider who moves: a driven joint that follows userdata (rolling.h).
typedef struct runner_rider {
  bool moves;   // as an input says; otherwise he is part of the frame, or moves by himself
  bool works;   // he moves, by whomever
  int qpos;     // address
  int dof;      // address
  int userdata; // address of his motion
  int work;     // address in act of the work done on the model
} runner_rider;

// Where in the mjModel the bicycle is; nothing else of the model is known.
typedef struct runner_map {
  int frame;               // id of the body rear_frame, or of what else carries the rear wheel
  bool foreign;            // made by others: of the root nothing is known but that it moves
  double axes[9];          // columns: (forward, left, up) in the frame body's axes; foreign only
  bool free_root;          // one free joint; otherwise slides x, y, z, hinges yaw, roll, pitch
  int root_qpos, root_dof; // their first addresses
  runner_hinge steer;      //
  runner_rider rider;      //
  runner_wheel wheel[RUNNER_WHEELS]; //
  bool exact;                        // rolling_discs; otherwise contacts
} runner_map;

struct runner {
  mjModel *model;
  mjData *ride;        // what mj_step advances
  mjData *probe;       // where instants are evaluated: measuring leaves no trace in a ride
  int disc_count;      //
  roll_disc *discs;    // of exact rolling, as measured last
  runner_map map;      //
  double rider_offset; // m   that the model was built with
  double yaw;          // rad of the instant before: yaw is continuous
  bike_state asked;    //     of the ride's start; NAN where nobody said
  // What the control callback reads and writes during a step.
  bike_input_function *input; // NULL: hands off
  void *user;                 // of the input
  int stages;                 //     calls since the step began
  double work;                // J   of torques and damper since the start (CVODE: the rider's too)
  double probe_power;         // W   of the same at the probe
  runner_status refused;      //     the input cannot be applied
};

//---------------------------------- the model (runner_map.c) --------------------------------------

// Finds the bicycle's bodies, joints and radii; false with a text naming what is missing or wrong.
bool runner_find_map(runner_map *map, const mjModel *model, mjcf_error *error);

// The same for a model with other names, axes or root (bicycle_import.h).
bool runner_find_foreign_map(runner_map *map, const mjModel *model, mjcf_error *error);

//---------------------------------- the input (runner_control.c) ----------------------------------

// From here on the control callback of this thread serves this runner (NULL: none). Returns the one
// it served before.
runner *runner_activate(runner *r);

// Puts a moving rider of d to where the input has him at d's time, with its velocity.
void runner_place_rider(runner *r, mjData *d);

// Work done on the bicycle since the start, J, that of a moving rider included.
double runner_work(const runner *r);

// The same's rate at the probe, W, after an mj_forward.
double runner_probe_power(const runner *r);

//---------------------------------- another integrator (runner_cvode.c) ---------------------------

// CVODE around mj_forward, in place of mj_step.
typedef struct runner_cvode runner_cvode;

// Ready to go on from the ride's state at time 0, work 0. NULL: out of memory, or SUNDIALS refused.
runner_cvode *runner_cvode_create(runner *r, double tolerance);
void runner_cvode_free(runner_cvode *c);

// Brings the ride's state and the work to a later time. Errors as those of a step.
runner_status runner_cvode_advance(runner_cvode *c, double time, mjcf_error *error);

long runner_cvode_steps(const runner_cvode *c);
long runner_cvode_evaluations(const runner_cvode *c);

//---------------------------------- attitude (runner_posture.c) -----------------------------------

// Rear frame in yaw, roll, pitch and their rates, as the hinge root has them: what a free joint
// says is brought to the same terms. Accelerations are filled if d->qacc is of this moment.
typedef struct runner_posture {
  double angle[3];        // rad      yaw, roll, pitch
  double rate[3];         // rad/s
  double acceleration[3]; // rad/s^2
} runner_posture;

// Of a foreign model accelerations need an mj_rnePostConstraint of this moment.
void runner_read_posture(runner_posture *out, const runner *r, const mjData *d);

// Sets qpos and qvel of the rear frame: hub displaced by `place` from its place at qpos0.
void runner_write_posture(const runner *r, mjData *d, const double place[3], const double angle[3]);
void runner_write_rates(const runner *r, mjData *d, const double velocity[3], const double rate[3]);

//---------------------------------- state (runner_start.c) ----------------------------------------

// Places d (time 0) at a state, consistent with both discs on the ground and rolling.
runner_status runner_place(runner *r, mjData *d, const bike_state *state, mjcf_error *error);

// Whether a start's angles, rad, are within BIKE_LARGEST_ANGLE.
bool runner_check_angles(double lean, double steer, mjcf_error *error);

// The same for a model made by others (runner_foreign.c); false where no start is found.
bool runner_place_foreign(const runner *r, mjData *d, const bike_state *state);

// Largest height error and contact velocity of the discs at d, as RUNNER_START_TOLERANCE counts
// them.
double runner_residual(const runner *r, const mjData *d);

//---------------------------------- discs and instants (runner_measure.c) -------------------------

typedef struct runner_disc {
  double point[3];    // m    lowest point
  double height;      // m    above the ground
  double velocity[3]; // m/s  of the wheel's material there
  double speed;       // m/s  size of the terms that make up this velocity, and may cancel
} runner_disc;

// Needs positions and mj_comVel of the moment.
void runner_find_disc(runner_disc *out, const runner *r, const mjData *d, int wheel);

// mj_forward on the probe, and all that can be read there.
runner_status runner_measure_probe(runner_instant *out, runner *r, mjcf_error *error);

// Takes the rounding off the first instant of a ride: what was asked for, and the origin.
void runner_settle_start(runner_instant *at, const runner *r);

// roll_check, what is wrong named in the text (runner_check.c).
roll_error runner_check_marker(const mjModel *m, mjcf_error *error);

// Whether all discs rolled at a time; else a text that names the first that did not.
bool runner_discs_roll(const roll_disc *discs, int count, double time, mjcf_error *error);

// The checks after every call that advances or evaluates (runner_check.c): errors and warnings of
// MuJoCo, callback, finite numbers.
struct guard_report;
runner_status runner_check(const runner *r, const mjData *d, const struct guard_report *report,
                           int stages, mjcf_error *error);

// The same for any model; warnings count only where MuJoCo counts them: what rolling.h says of
// discs that go on rolling does not.
runner_status runner_check_any(const mjModel *m, const mjData *d, const struct guard_report *report,
                               mjcf_error *error);

// Whether a step brought d from that time on by one timestep.
runner_status runner_check_time(const mjData *d, double from, double step, mjcf_error *error);

//---------------------------------- linear systems (runner_solve.c) -------------------------------

// A x = b (A n x n, row-major) by elimination with row pivots; b becomes x, A is used up. False if
// A is singular.
bool runner_solve(int n, double *A, double *b);

//---------------------------------- times (runner_times.c) ----------------------------------------

// How often `part` goes into `whole`, and whether it does so without a rest: times are typed in
// decimals, so that 0.03/0.01 is 3 only to rounding.
bool runner_divides(long *times, double whole, double part);

// Whether duration and sample interval go together with a timestep; else a text.
bool runner_check_times(double duration, double sample, double step, mjcf_error *error);

// Of a clock that only runs forwards, s.
double runner_seconds(void);

#endif
