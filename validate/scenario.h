// SPDX-License-Identifier: Apache-2.0
// A scenario: what is ridden, by which engines, and what must come out. Read from YAML; the keys
// are explained in README.md.
#ifndef VALIDATE_SCENARIO_H
#define VALIDATE_SCENARIO_H

#include "engine.h"
#include "measurement.h"

#include "files/sha256.h"

#include <bicycle/input.h>
#include <stdint.h>

struct layer;

enum {
  SCENARIO_NAME = 64,
  SCENARIO_TITLE = 160,
  SCENARIO_STOPS = 160,
  SCENARIO_PATH = 4096, // PATH_MAX of Linux
  GATE_REASON = 400,
  GATE_MAX_SIGNALS = 16
};

// A limit on one metric of some signals. It holds for what all engines measured under that name.
typedef struct gate_rule {
  const struct layer *layer;                        //
  char metric[MEASUREMENT_NAME];                    //
  char signals[GATE_MAX_SIGNALS][MEASUREMENT_NAME]; //
  int signal_count;                                 // 0: all signals of the layer
  bool information;                                 // measured, not judged: the limit says nothing
  double limit;                                     // >= 0, of the measurement's unit
  double time_tolerance;                            // s  >= 0, of the metric 'tube'
  double nominal;                                   // of 'nrmse': least size; 0: the layer's own
  double from, to;                                  // s  of a ride, both included; to 0: the end
  char reason[GATE_REASON];                         // why the limit has its value
} gate_rule;

typedef struct gate_rules {
  gate_rule *items;
  size_t count, room;
  double duration, sample; // s  of the ride in which windows must lie; 0: not known
} gate_rules;

// Random states of L0, uniform within these ranges, the same for the same seed on every machine.
typedef struct scenario_instants {
  int count;          // beside the start state
  uint64_t seed;      //
  double lean, steer; // rad    at most, either side
  double rate;        // rad/s  of both, at most, either side
  double slow, fast;  // m/s    speed
} scenario_instants;

// By how much two rides that differ slightly may part: exp(rate t).
typedef struct scenario_growth {
  bool unstable_mode; // the rate is the largest real part of the eigenvalues of upright riding at
                      // the start speed
  double rate;        // 1/s  otherwise
} scenario_growth;

enum { SCENARIO_MAX_STEPS = 8 };

// L1: eigenvalues of both engines over speeds.
typedef struct scenario_linear {
  int count;         // of speeds, ends included; 0: not asked
  double slow, fast; // m/s
} scenario_linear;

// L4: the candidate's ride with several steps.
typedef struct scenario_convergence {
  int count;                       // of steps; 0: not asked
  double step[SCENARIO_MAX_STEPS]; // s  falling
  double order;                    //    expected; NaN: what the engine says of itself
  double tolerance;                //    of the signals' units: models that differ by less are one
  bool different;                  //    the models are expected to differ
} scenario_convergence;

// L5: up to where an unstable ride can be predicted.
typedef struct scenario_horizon {
  bool asked;
  double share; // of the L2 limit that a twin disturbed by one ulp may use up
} scenario_horizon;

// L6: what a ride costs.
typedef struct scenario_cost {
  int repeats; // 0: not asked
} scenario_cost;

// What acts on the bicycle: torques that stay, or a file of torques and the rider's motion. All
// zero: hands off.
typedef struct scenario_input {
  double steer_torque, roll_torque; // N m
  char name[SCENARIO_PATH];         // of the file, as the scenario says it; empty without one
  char path[SCENARIO_PATH];         //
  char sha256[SHA256_HEX_SIZE];     // of the file, in hexadecimal
  bike_input_table *table;          // NULL without
} scenario_input;

typedef struct scenario {
  char name[SCENARIO_NAME];           // the file's name without .yml
  char path[SCENARIO_PATH];           //
  char title[SCENARIO_TITLE];         //
  char bicycle_name[SCENARIO_PATH];   // as the file names it
  char model_path[SCENARIO_PATH];     // of a bicycle that came as a MuJoCo model; else empty
  char stops[SCENARIO_STOPS];         // joints that such a model limits, and where; else empty
  bike_bicycle bicycle;               //
  bike_model model;                   //
  double rider_offset;                // m  to the right; already in `bicycle`
  bike_state start;                   //
  scenario_input input;               //
  double duration, sample;            // s
  scenario_growth growth;             //
  scenario_instants instants;         //
  scenario_linear linear;             //
  scenario_convergence convergence;   //
  scenario_horizon horizon;           //
  scenario_cost cost;                 //
  engine_choice reference, candidate; //
  gate_rules rules;                   // where several fit a measurement, the last one judges it
} scenario;

// Reads a scenario and the files it names. TERM_USAGE with "path:line: key: what", or TERM_INVALID
// without memory; `out` need not be cleared then.
term_exit scenario_read(scenario *out, const char *path, problem *p);
void scenario_clear(scenario *s);

// The lean at which rides end, rad, the same for all engines; a scenario's start is below it.
double scenario_lean_limit(void);

// Whether anything acts on the bicycle, and what at a time (a bike_input_function).
bool scenario_has_input(const scenario_input *input);
void scenario_input_at(double time, bike_input *out, void *input);

// Path of a scenario on a command line: a file, or the name of a shipped one.
term_exit scenario_find(char out[SCENARIO_PATH], const char *given, problem *p);

// Paths of the shipped scenarios by name; free each and the list.
term_exit scenario_list(char ***out, size_t *count, problem *p);

#endif
