// SPDX-License-Identifier: Apache-2.0
// One point of a sweep: which values the axes have there, and the bicycle and start they make.
#ifndef SWEEP_POINT_H
#define SWEEP_POINT_H

#include "spec.h"

#include <bicycle/model.h>
#include <bicycle/state.h>

enum { SWEEP_REASON_SIZE = 256 };

typedef struct sweep_point {
  double values[SWEEP_MOST_AXES]; // by axis
  bike_model model;
  bike_state start;              // its speed as the spec says, 0 where it says none
  double rider_offset;           // m
  int code;                      // BIKE_OK, or why there is no such bicycle
  char error[SWEEP_REASON_SIZE]; // the same in words; empty: there is
} sweep_point;

// Point `index`, 0 <= index < spec->points: a function of the spec and the index alone.
void sweep_point_at(sweep_point *out, const sweep_spec *spec, long index);

// Its values alone, by axis.
void sweep_values_at(double out[SWEEP_MOST_AXES], const sweep_spec *spec, long index);

#endif
