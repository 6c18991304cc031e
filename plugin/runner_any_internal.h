// SPDX-License-Identifier: Apache-2.0
// What the files of runner_any share; not for users.
#ifndef RUNNER_ANY_INTERNAL_H
#define RUNNER_ANY_INTERNAL_H

#include "runner_any.h"
#include "runner_internal.h"

struct runner_any {
  mjModel *model;
  mjData *ride;  // what mj_step advances
  mjData *probe; // where moments are evaluated
  int disc_count, drive_count;
  roll_disc *discs;
  roll_drive *drives;
};

// Brings the ride's state to the probe and evaluates it there: energies, sensors, discs, drives.
// A disc or drive that does not roll is INVALID_WARNING with its name. `note` gets the first
// warning that does not end a ride, or "".
enum { RUNNER_NOTE_SIZE = 256 };
runner_status runner_any_measure(runner_any *r, char note[RUNNER_NOTE_SIZE], mjcf_error *error);

// Whether the wheels roll at the moment measured, as rolling.h judges it; INVALID_WARNING if not.
runner_status runner_any_check_rolling(const runner_any *r, mjcf_error *error);

#endif
