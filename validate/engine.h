// SPDX-License-Identifier: Apache-2.0
// An engine: anything that can say what a bicycle does at an instant and during a ride.
//
// An engine is one const struct of functions. To add one, write engine_NAME.c and name its struct
// in engines.c; nothing else knows which engines there are. Engines share no code with each other
// beyond this header, so that their agreement means something.
#ifndef VALIDATE_ENGINE_H
#define VALIDATE_ENGINE_H

#include "problem.h"
#include "trace.h"

#include <bicycle/state.h>

enum {
  ENGINE_MAX_OPTIONS = 8,
  ENGINE_MAX_COLUMNS = 32,
  ENGINE_COLUMN_SIZE = 64,
  ENGINE_PATH_SIZE = 4096, // PATH_MAX of Linux
  ENGINE_VERSION_SIZE = 96,
  ENGINE_HASH_SIZE = 65
};

// An option of an engine in a scenario: a positive number, or one of a few words.
typedef struct engine_option {
  const char *name;           //
  const char *unit;           // of a number
  const char *const *choices; // NULL-terminated; NULL: a number
  double value;               // the default: a number > 0, or the index of a choice
} engine_option;

// What an engine says of a state, all of it at x = y = yaw = 0. Accelerations and rates are about
// the directions of bike_snapshot; index 0: rear, 1: front wheel.
typedef struct engine_instant {
  double lean_acceleration, steer_acceleration, yaw_acceleration, pitch_acceleration; // rad/s^2
  double wheel_acceleration[2];                                                       // rad/s^2
  double speed_rate;                                                                  // m/s^2
  double yaw_rate, pitch_rate;                                                        // rad/s
  double wheel_rate[2];                                                               // rad/s
  double pitch;                                                                       // rad
  double kinetic, potential;                                                          // J
  double force[2][3]; // N  of the ground on the wheel (along e_R, left, up)
  bool at_stop;       //    a stop of the model acts, which the equations do not have
} engine_instant;

// Called after each row of a ride with the share done, 0..1; false interrupts the ride.
typedef bool engine_progress(double share, void *user);

typedef struct engine_ride {
  bike_state start;           //
  double duration, sample;    // s
  double lean_limit;          // rad  the ride ends there; the start is below it
  bike_input_function *input; //      NULL: hands off
  void *input_user;           //      its argument
  const double *breakpoints;  // s    rising times at which the input is not smooth
  size_t breakpoint_count;    //
  engine_progress *progress;  //  may be NULL
  void *user;                 //
} engine_ride;

// Where a recorded ride has a signal: its column, and by what that is multiplied to become SI with
// the signs of this project.
typedef struct engine_column {
  char signal[ENGINE_COLUMN_SIZE]; // of trace_signals, or "time"
  char column[ENGINE_COLUMN_SIZE]; // in the header of the file
  double scale;
} engine_column;

struct engine;

// An engine with its options, as a scenario asks for it.
typedef struct engine_choice {
  const struct engine *engine;
  double option[ENGINE_MAX_OPTIONS];
  // The user's own MuJoCo model of the bicycle, as it is opened; empty: the bicycle came as a
  // bicycle file, and an engine makes its model itself.
  char model[ENGINE_PATH_SIZE];
  bool moving_rider; // the rides' input moves the rider
  // Of an engine that plays a recorded ride:
  char file[ENGINE_PATH_SIZE];               // its path, as it is opened
  engine_column columns[ENGINE_MAX_COLUMNS]; //
  int column_count;                          // 0: columns have the names of the signals
} engine_choice;

typedef struct engine {
  const char *name;    // in scenarios: "mujoco"
  const char *summary; // one line

  const engine_option *options; // option_count of them; NULL without
  int option_count;             // <= ENGINE_MAX_OPTIONS
  const char *step_option;      // the one that is the step of integration; NULL: none
  bool plays_file;              // it needs a file, and may have a map of columns
  bool takes_input;             // rides of it need not be hands off
  bool alone;                   // it changes what is process-global: nothing is played beside it

  // Looks through what the engine is given from outside, before anything is played. NULL: nothing.
  term_exit (*check)(const engine_choice *choice, const engine_ride *ride, problem *p);

  // An instance for a bicycle. NULL with a problem and its exit code in `code` otherwise.
  void *(*create)(const bike_bicycle *bicycle, const engine_choice *choice, term_exit *code,
                  problem *p);
  void (*free)(void *instance);

  // The programs and versions at work: "MuJoCo 2.2.2".
  void (*version)(char out[ENGINE_VERSION_SIZE]);

  // SHA-256 of what the engine made of the bicycle (the text of its model), in hexadecimal; NULL
  // for an engine that uses the bicycle's numbers as they are.
  void (*model_hash)(char out[ENGINE_HASH_SIZE], void *instance);

  // The bicycle as the engine's own model holds it, read back: at most one part for each assembly.
  // NULL for an engine that uses the bicycle's numbers as they are.
  term_exit (*parameters)(bike_bicycle *out, void *instance, problem *p);

  // The order with which a ride's error falls with its step; 0 where no option is a step, or where
  // the error is not a power of it. NULL: 0.
  double (*order)(const engine_choice *choice);

  // The instant at a state, hands off. TERM_USAGE: the state is outside the engine's domain. NULL:
  // the engine knows rides only.
  term_exit (*evaluate)(engine_instant *out, void *instance, const bike_state *state, problem *p);

  // Mass matrix (3 x 3, row-major, SI) of the rolling bicycle for (lean rate, steer rate, speed):
  // with these rates r the kinetic energy is r.M r / 2. Errors as `evaluate`. NULL: not known.
  term_exit (*mass_matrix)(double M[9], void *instance, const bike_state *state, problem *p);

  // A (4 x 4, row-major) of x' = A x near upright straight riding at a speed, x = (steer, lean,
  // steer rate, lean rate), by the engine's own means. NULL: it has none.
  term_exit (*linearize)(double A[16], void *instance, double speed, problem *p);

  // Rides and records into an empty trace. TERM_DONE also when an event ended the ride.
  term_exit (*ride)(trace *out, void *instance, const engine_ride *ride, problem *p);
} engine;

extern const engine engine_analytic, engine_mujoco, engine_linear, engine_file, engine_disc,
    engine_mujoco_disc;

// All engines by number; NULL beyond the last.
const engine *engine_at(int index);
const engine *engine_find(const char *name);

// The engine with its default options.
engine_choice engine_default_choice(const engine *e);

// The order with which a ride's error falls with its step, 0 where it does not: see `order`.
double engine_order(const engine_choice *choice);

// Index of an option, or -1.
int engine_option_index(const engine *e, const char *name);

// Seconds on the clock by which engines time themselves, and of the processor by this thread.
double engine_clock(void);
double engine_processor_clock(void);

#endif
