// SPDX-License-Identifier: Apache-2.0
// A bicycle as people describe it: five lengths, and parts with mass, place and inertia.
//
// Source: Franke, Suhr, Riess, "An advanced model of bicycle dynamics", Eur. J. Phys. 11 (1990)
// 116-121, figure 1 and equations (4)-(7); Meijaard, Papadopoulos, Ruina, Schwab, "Linearized
// dynamics equations for the balance and steer of a bicycle", Proc. R. Soc. A 463 (2007).
//
// Units are SI and radians. Places and tensors of parts, front parts too, are given for the
// upright, unsteered bicycle in (forward, left, up), from the rear wheel's contact point.
#ifndef BICYCLE_BICYCLE_H
#define BICYCLE_BICYCLE_H

#include <bicycle/export.h>
#include <stdbool.h>

enum { BIKE_NAME_SIZE = 64, BIKE_MAX_PARTS = 32 };

// No number that the equations are given is larger in magnitude, in SI units, but inertias, which
// may be as large as its square: their products, of up to some ten numbers, then stay within a
// double's range. BIKE_ERROR_NOT_FINITE for a larger one.
#define BIKE_LARGEST 1e20

// The rigid assembly to which a part belongs. A wheel turns about its hub relative to its frame.
typedef enum bike_assembly {
  BIKE_REAR_FRAME,
  BIKE_REAR_WHEEL,
  BIKE_FRONT_FRAME,
  BIKE_FRONT_WHEEL
} bike_assembly;

// The frame's lengths (figure 1). The reference axes are N (right), p, S (up along the steering
// axis); the steering axis meets the perpendicular from the front hub at the point x0 = 0.
typedef struct bike_geometry {
  double L_r; // m   rear hub behind the steering axis: its x0 is (0, -L_r, L_s)
  double L_f; // m   front hub before the steering axis: its x0 is (0, L_f, 0)
  double L_s; // m   rear hub above that perpendicular, along the axis; may be negative
  double R_r; // m   rear wheel's radius, > 0; at least 1e-9 of the five together, and 1e-20
  double R_f; // m   front wheel's radius, likewise
} bike_geometry;

typedef struct bike_part {
  char name[BIKE_NAME_SIZE]; // unique within the bicycle, not empty
  bike_assembly assembly;    // what it moves with
  bool rider;                // the part that a rider offset displaces; rear frame only, at most one
  double mass;               // kg        > 0
  double position[3];        // m         (forward of the rear contact, left, up); a wheel: its hub
  double inertia[6];         // kg m^2    Ixx, Iyy, Izz, Ixy, Ixz, Iyz about its centre of mass;
                             //           positive semidefinite; a wheel: Ixx = Izz, products zero
} bike_part;

typedef struct bike_bicycle {
  char name[BIKE_NAME_SIZE];       // what tables and reports call it
  bike_geometry geometry;          //
  double gravity;                  // m/s^2        > 0
  double steer_damping;            // N m s/rad    d >= 0 of the steer torque -d * steer_rate
  int part_count;                  //              1 .. BIKE_MAX_PARTS
  bike_part parts[BIKE_MAX_PARTS]; //
} bike_bicycle;

// The bicycle standing upright and unsteered.
typedef struct bike_upright {
  double tilt;        // rad  beta_r = beta_f: the steering axis leans back by this; head angle =
                      //      pi/2 - tilt
  double wheelbase;   // m    front contact before the rear contact
  double trail;       // m    T_f of equation (5): steering axis meets the ground before the contact
  double axis_ground; // m    T_r of equation (6): steering axis on the ground, from rear contact
  double foot_height; // m    Z_0 of equation (7)
  double rear_hub[3]; // m    (forward of the rear contact, left, up)
  double front_hub[3]; // m
} bike_upright;

// A bicycle without parts, standard gravity 9.81 m/s^2 and no damping: fill in the rest.
BIKE_API bike_bicycle bike_default_bicycle(void);

// The five lengths of a bicycle given as builders do.
//   wheelbase, trail  m, between the contact points; trail > 0 behind the steering axis
//   tilt              rad, of the steering axis from the vertical (head angle = pi/2 - tilt)
//   R_r, R_f          m, wheel radii
// Any numbers give some lengths; whether they are a bicycle's, bike_upright_position tells.
BIKE_API bike_geometry bike_geometry_from_wheelbase(double wheelbase, double trail, double tilt,
                                                    double R_r, double R_f);

// Upright position of a geometry. BIKE_ERROR_IMPOSSIBLE where no such position exists, or only one
// made of rounding: a steering axis within 1e-9 rad of the horizontal, a wheelbase below 1e-9 of
// the five lengths together. NOT_FINITE where a number of it would not be finite.
BIKE_API int bike_upright_position(bike_upright *out, const bike_geometry *geometry);

// Checks every rule stated above. On BIKE_ERROR_PARAMETER or BIKE_ERROR_NOT_FINITE `part` tells
// which part breaks a rule (its index, or -1 for the bicycle itself) and `what` points to a static
// text naming the member and the rule, as in "mass must be positive". Both may be NULL.
BIKE_API int bike_check(const bike_bicycle *bicycle, int *part, const char **what);

#endif
