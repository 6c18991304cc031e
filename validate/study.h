// SPDX-License-Identifier: Apache-2.0
// What layers find out beyond single numbers, for the reports. Each is there where the scenario
// asks for it.
#ifndef VALIDATE_STUDY_H
#define VALIDATE_STUDY_H

#include "scenario.h"

#include <bicycle/stability.h>

// Signals of which convergence and horizon are studied, both in rad.
enum { STUDY_SIGNALS = 2, STUDY_SIDES = 2 };
extern const char *const study_signals[STUDY_SIGNALS]; // "lean", "steer"

//---------------------------------- L1 ------------------------------------------------------------

typedef struct study_modes {
  double speed;                         // m/s
  bike_eigenvalues engine[STUDY_SIDES]; // of the reference, of the candidate
  double error;                         // largest |difference|/max(1, |eigenvalue|), best matched
} study_modes;

typedef struct study_linear {
  int count;                               // of speeds; 0: not asked
  study_modes *modes;                      //
  bike_critical_speeds speed[STUDY_SIDES]; // weave and capsize alone
} study_linear;

//---------------------------------- L2 ------------------------------------------------------------

// The shift in time that explains most of how one of the study's signals differs.
typedef struct study_shift {
  double time;  // s  the candidate is late by this
  double share; //    of the mean square difference that it explains, 0..1
} study_shift;

//---------------------------------- L4 ------------------------------------------------------------

typedef enum study_verdict {
  STUDY_SAME,      // the order is the expected one, no plateau: same equations
  STUDY_DIFFERENT, // a plateau that no smaller step removes: different model
  STUDY_UNDECIDED  // no plateau is seen, but the order is not the expected one
} study_verdict;

// "same equations", "different model", "another order".
const char *study_verdict_string(study_verdict v);

typedef struct study_point {
  double step;                 // s
  long steps, evaluations;     //
  double wall_time, cpu_time;  // s
  double error[STUDY_SIGNALS]; // rad  largest |candidate - reference|
} study_point;

typedef struct study_signal {
  double order;        //      slope of log(error) over log(step)
  double scatter;      //      root mean square of what the slope leaves of log(error)
  double power;        //      of the error's first term, with which it is extrapolated
  double plateau;      // rad  largest |limit for step 0 - reference|
  double plateau_time; // s    where it stands
  double uncertainty;  // rad  largest difference of the last two columns of the extrapolation
  study_verdict verdict;
} study_signal;

typedef struct study_convergence {
  int count; // of steps; 0: not asked
  study_point point[SCENARIO_MAX_STEPS];
  double order;                       // expected
  int terms;                          // of the error that the extrapolation removes
  bool complete;                      // every ride lasted to the end
  study_signal signal[STUDY_SIGNALS]; //
  study_verdict verdict;              // the worse of the signals'
} study_convergence;

//---------------------------------- L5 ------------------------------------------------------------

typedef struct study_horizon {
  bool asked;
  double time;                   // s    up to here the ride can be predicted, and is judged
  double disturbance;            // rad  of the twin's lean
  char signal[MEASUREMENT_NAME]; //      the first to use up its share; empty: none does
  double exponent;               // 1/s  with which a small disturbance grows; NaN: cannot be told
  double eigenvalue;             // 1/s  largest real part at upright riding with the start's speed
} study_horizon;

//---------------------------------- L6 ------------------------------------------------------------

enum { STUDY_MAX_RUNS = 16 };

// A ride timed several times.
typedef struct study_run {
  int side;                 // 0: reference, 1: candidate
  char setting[64];         // "rtol 1e-10", "timestep 0.001"
  long steps, evaluations;  //
  double median, low, high; // s    elapsed
  double cpu;               // s    of a processor, median
  double error;             // rad  largest |lean - that of the reference as asked for|
} study_run;

typedef struct study_cost {
  int repeats; // 0: not asked
  int count;   // of runs; the first two are those of the scenario itself
  study_run run[STUDY_MAX_RUNS];
} study_cost;

typedef struct study_results {
  study_linear linear;
  study_shift shift[STUDY_SIGNALS];
  study_convergence convergence;
  study_horizon horizon;
  study_cost cost;
} study_results;

void study_clear(study_results *s);

#endif
