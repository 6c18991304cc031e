// SPDX-License-Identifier: Apache-2.0
// Headless rides of any model in which something rolls, glides or is driven (rolling.h), in the
// model's own coordinates; no bicycle is looked for. Checked at every step like those of runner.h,
// whose words on threads hold here too.
#ifndef RUNNER_ANY_H
#define RUNNER_ANY_H

#include "rolling.h"
#include "runner.h"

typedef struct runner_any runner_any;

// The model of a file (.xml, .mjb). NULL with a text in `error`: RUNNER_MODEL, nothing is marked or
// the file is no model; RUNNER_ARGUMENT, what is marked cannot roll; RUNNER_MEMORY. Free with
// runner_any_free; NULL is allowed there.
runner_any *runner_any_load(const char *path, runner_status *status, mjcf_error *error);
void runner_any_free(runner_any *r);

// To be read or, before the start, changed in integrator and timestep.
mjModel *runner_any_model(runner_any *r);

// Residual allowed at the start, relative to 1 + the largest |qpos| and |qvel| as in roll_project,
// which reaches 1e-13: keyframes have 17 digits, and some roundings go into them.
#define RUNNER_ANY_START_TOLERANCE 1e-12

// Time 0 at the keyframe `test` or, without one, at rest in qpos0. Where wheels are off the ground
// or slip: RUNNER_START or, with `project`, put right by roll_project, which moves qpos or qvel by
// `moved` at most (may be NULL). Also INVALID_*.
runner_status runner_any_start(runner_any *r, bool project, double *moved, mjcf_error *error);

// A moment of a ride. What is pointed to is valid during the call.
typedef struct runner_moment {
  double time;              // s
  const mjData *data;       //   after an mj_forward of its own
  const roll_disc *discs;   //   disc_count of them, in the order of rolling.h
  const roll_drive *drives; //   drive_count of them
} runner_moment;

int runner_any_disc_count(const runner_any *r);
int runner_any_drive_count(const runner_any *r);

typedef struct runner_any_def {
  double duration;   // s   > 0, a multiple of the timestep; moments at k * sample
  double sample;     // s   a multiple of the timestep
  bool stop_at_lift; //     a disc that lifts ends the ride
  int (*on_sample)(const runner_moment *moment, void *user); // required; nonzero: stop
  void (*on_lift)(int disc, double time, void *user);        // a normal force falls to 0,
                                                             // linearly within a step
  void (*on_note)(const char *text, void *user);             // a warning that does not end
                                                             // the ride, one line
  void *user;                                                // of all three
} runner_any_def;

typedef struct runner_any_result {
  double end_time;  // s   reached
  bool complete;    //     the whole duration was ridden
  long steps;       //
  double wall_time; // s   spent in mj_step alone
} runner_any_result;

// Whether runner_any_ride would take the definition: RUNNER_OK or RUNNER_ARGUMENT.
runner_status runner_any_check(const runner_any *r, const runner_any_def *def, mjcf_error *error);

// Rides on from the start. What rolling.h warns of without leaving a disc free is a note; MuJoCo's
// own warnings, a disc left free, a reset or a state that is not finite end the ride: INVALID_*.
runner_status runner_any_ride(runner_any_result *out, runner_any *r, const runner_any_def *def,
                              mjcf_error *error);

#endif
