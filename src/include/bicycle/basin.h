// SPDX-License-Identifier: Apache-2.0
// The basin of attraction of riding straight: from which leans and steers the bicycle, hands off,
// comes back to it by itself.
//
// Section 4 of Franke, Suhr, Riess (1990) speaks of "a very large basin of attraction". All starts
// have zero rates and the energy of riding straight at one speed, so that this is the motion to
// which they can come back. Lifts of the wheels are watched, the friction that is asked is not.
#ifndef BICYCLE_BASIN_H
#define BICYCLE_BASIN_H

#include <bicycle/ensemble.h>
#include <stddef.h>

typedef enum bike_fate {
  BIKE_FATE_STRAIGHT, // comes back to riding straight, both wheels on the ground all the time;
                      // never where riding straight at this speed is not stable
  BIKE_FATE_LIFTED,   // the equations come back, but a wheel would have left the ground on the way
  BIKE_FATE_RIDING,   // still rides when the time is over, but not straight
  BIKE_FATE_FALLEN,   // falls: the lean limit, or the end of the equations' range
  BIKE_FATE_NO_START, // no such state: no geometry, or no speed gives this energy
  BIKE_FATES
} bike_fate;

BIKE_API const char *bike_fate_string(bike_fate fate); // "straight", "lifted", ...

typedef struct bike_basin_def {
  double speed;                   // m/s  of riding straight, > 0
  const double *leans, *steers;   // rad  the grid
  size_t lean_count, steer_count; //
  double duration;                // s    after which a ride is given up
  double settled; // rad  riding counts as straight once lean, steer and their rates (rad/s) have
                  //      stayed below this for a second
  int threads;    //      >= 1
  void (*progress)(double done, void *user); // may be NULL; called by the calling thread alone
  void *user;
} bike_basin_def;

// 60 s, settled at 0.005 rad, one thread; fill in the speed and the grid.
BIKE_API bike_basin_def bike_default_basin_def(void);

// out[j * lean_count + i] for leans[i], steers[j]. Errors: ARGUMENT, NOT_STATIONARY (a
// bicycle that is not mirror-symmetric), SOLVER.
BIKE_API int bike_basin(bike_fate *out, const bike_model *model, const bike_basin_def *def);

// One start; `time` (s, may be NULL) is when its fate was decided.
BIKE_API int bike_fate_of(bike_fate *out, double *time, const bike_model *model,
                          const bike_basin_def *def, double lean, double steer);

// The same for any start, with its own speed and rates and the rider held at an offset (m); of
// `def` only `duration` and `settled` are used. What the ride settles to is judged there and then,
// at the speed that it has (a damper takes energy away): STRAIGHT where every motion about it
// decays. With an offset, or a bicycle that is not mirror-symmetric, it is a stationary circle
// instead of riding straight: the rates alone have stayed below `settled`. Errors: ARGUMENT,
// NO_RIDER, NOT_FINITE, SOLVER, MEMORY.
BIKE_API int bike_fate_of_start(bike_fate *out, double *time, const bike_model *model,
                                const bike_basin_def *def, const bike_state *start,
                                double rider_offset);

// The same for many, ridden together: codes[i] is the error of member i, 0 otherwise; `times` may
// be NULL; `threads` and `progress` are used too. Of a member's input only the rider's offset may
// differ from zero; `circles` is not read. Each result depends on its member alone.
BIKE_API int bike_fates_of_starts(bike_fate *out, double *times, int *codes,
                                  const bike_member *members, size_t count,
                                  const bike_basin_def *def);

#endif
