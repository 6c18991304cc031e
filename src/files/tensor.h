// SPDX-License-Identifier: Apache-2.0
// Masses lumped into one: mass, centre and tensor, in the axes and order of bike_part.
#ifndef FILES_TENSOR_H
#define FILES_TENSOR_H

#include <bicycle/bicycle.h>

typedef struct bike_lump {
  double mass;       // kg
  double centre[3];  // m
  double inertia[6]; // kg m^2   Ixx, Iyy, Izz, Ixy, Ixz, Iyz about the centre
} bike_lump;

// Adds to `tensor` that of a point mass at `arm` from the origin, `mass` < 0 to take it away.
void bike_add_point(double tensor[6], double mass, const double arm[3]);

// All parts of one assembly; mass 0 where it has none.
bike_lump bike_lump_parts(const bike_bicycle *bicycle, bike_assembly assembly);

// Takes a point mass out of a lump. False where what is left could not exist: no mass, or a tensor
// with a negative eigenvalue beyond rounding.
bool bike_take_point(bike_lump *lump, double mass, const double position[3]);

// Sets eigenvalues within `rounding` of zero to zero; false where one is below -rounding.
bool bike_make_semidefinite(double tensor[6], double rounding);

#endif
