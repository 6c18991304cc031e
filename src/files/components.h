// SPDX-License-Identifier: Apache-2.0
// What a file of `parameterization: components` says, number by number.
#ifndef FILES_COMPONENTS_H
#define FILES_COMPONENTS_H

#include "yaml.h"

#include <bicycle/bicycle.h>

typedef enum bike_inertia_kind {
  BIKE_INERTIA_NONE,
  BIKE_INERTIA_SPIN,
  BIKE_INERTIA_STEERING,
  BIKE_INERTIA_FULL
} bike_inertia_kind;

typedef struct bike_component {
  bike_part part;         // its tensor is filled in when the steering axis is known
  bike_inertia_kind kind; //
  double theta;           // kg m^2   of spin and steering
  bool has_position;      //
  bike_field field;       // the whole entry, while its file is open
} bike_component;

typedef struct bike_measures {
  double wheelbase, trail;          // m
  double head_angle;                // rad  from the horizontal
  double rear_radius, front_radius; // m
} bike_measures;

typedef struct bike_description {
  char name[BIKE_NAME_SIZE];              //
  double gravity, steer_damping;          //
  bool by_lengths;                        // the file gives the five lengths, not the measures
  bike_measures measures;                 // where it gives these
  bike_geometry geometry;                 // in any case
  bike_field geometry_field, parts_field; // while the file is open
  int count;                              //
  bike_component parts[BIKE_MAX_PARTS];   //
} bike_description;

bike_geometry bike_geometry_of_measures(const bike_measures *measures);

// The tensor of a part whose file gives one moment only, for a steering axis of that tilt.
void bike_component_tensor(bike_component *component, double tilt);

#endif
