// SPDX-License-Identifier: Apache-2.0
// What a sweep is: a bicycle, axes, and what is asked of each point. Read from YAML, see README.md.
#ifndef SWEEP_SPEC_H
#define SWEEP_SPEC_H

#include "files/sha256.h"
#include "output.h"

#include <bicycle/parameters.h>
#include <bicycle/variant.h>
#include <stdint.h>

enum {
  SWEEP_MOST_AXES = 64,
  SWEEP_MOST_POINTS = 1000000000 // a bit each in memory, and eight bytes when merged
};

// What an axis changes.
typedef enum sweep_target {
  SWEEP_FILE_NUMBER, // of the bicycle file, `index` as of bike_parameters
  SWEEP_PROPERTY,    // `index` is a bike_variation
  SWEEP_SPEED,       // m/s
  SWEEP_LEAN,        // rad
  SWEEP_STEER,       // rad
  SWEEP_LEAN_RATE,   // rad/s
  SWEEP_STEER_RATE,  // rad/s
  SWEEP_RIDER_OFFSET // m
} sweep_target;

// Which values it takes.
typedef enum sweep_law {
  SWEEP_LIST,    // list[0 .. count - 1]
  SWEEP_GRID,    // count values from a to b, both included
  SWEEP_UNIFORM, // drawn from [a, b)
  SWEEP_NORMAL   // drawn: mean a, standard deviation b
} sweep_law;

typedef struct sweep_axis {
  char name[BIKE_FILE_NUMBER_SIZE]; // as the spec writes it
  sweep_target target;              //
  int index;                        //
  sweep_law law;                    //
  long count;                       // 1 where it is drawn
  double a, b;                      //
  double *list;                     //
  int stream;                       // of draws: which of the drawn axes, from 0
} sweep_axis;

typedef struct sweep_spec {
  char hash[SHA256_HEX_SIZE];               // of the spec's and the bicycle's file
  bike_file file;                           //
  bike_parameters *parameters;              // of the bicycle
  bike_front_hold front;                    // what properties hold
  int axis_count;                           //
  sweep_axis axes[SWEEP_MOST_AXES];         // the last one varies fastest, draws faster still
  int output_count;                         //
  sweep_output outputs[SWEEP_OUTPUT_COUNT]; // in the order of the columns
  bool has_seed;                            //
  uint64_t seed;                            //
  long draws;                               // of each point of the grid; 1 without drawn axes
  double search[2]; // m/s  where critical speeds are looked for; NaN: from 0 to
                    //      bike_search_end
  double ride_time; // s    when a ride is given up
  double settled;   // rad  as of bike_basin_def
  bool same_energy; // the speed is that of riding straight with the energy of the start
  long points;      // of the whole sweep
} sweep_spec;

// Reads a spec and its bicycle. BIKE_ERROR_... with one line "path:line:column: key: what" in
// `error`; `out` is safe to free always.
int sweep_spec_read(sweep_spec *out, const char *path, bike_file_error *error);
void sweep_spec_free(sweep_spec *spec);

// The axis with that target, or NULL.
const sweep_axis *sweep_find_axis(const sweep_spec *spec, sweep_target target);

#endif
