// SPDX-License-Identifier: Apache-2.0
// The bicycle as the equations see it: rigid parts lumped once into a rear and a front body.
#ifndef BICYCLE_MODEL_H
#define BICYCLE_MODEL_H

#include <bicycle/bicycle.h>

// One frame with all that is rigid to it, and the spin of its wheel.
// Axes: (N right, p, S up along the steering axis) of the frame it belongs to.
typedef struct bike_body {
  double mass;         // kg
  double centre[3];    // m        centre of mass; rear: from the rear hub, front: from the foot of
                       //          the perpendicular from the front hub onto the steering axis
  double moment[3];    // kg m     mass times centre
  double inertia[6];   // kg m^2   NN, pp, SS, Np, NS, pS about that hub or foot point, the wheel's
                       //          axial inertia left out
  double spin_inertia; // kg m^2   the wheel's inertia about its hub axis
} bike_body;

// Constant after bike_model_init; may be shared between threads.
typedef struct bike_model {
  bike_geometry geometry; //
  double gravity;         // m/s^2
  double steer_damping;   // N m s/rad
  double tilt;            // rad     upright beta_r
  double s_tilt, c_tilt;  //         its sine and cosine
  double tilt_gain;       //         beta_r = tilt + tilt_gain phi (kappa - s_tilt phi/2) + ...
  double newton_scale;    // m^-1/2  1/sqrt(2 wheelbase): size of the numbers that find beta_r
  double over_R_r;        // 1/m     1/R_r
  double over_R_f;        // 1/m     1/R_f
  double reach;           // m       |L_r| + |L_f| + |L_s| + R_r + R_f: size of the terms of (4)
  bike_body rear;         //         with the rider at rider offset zero
  bike_body front;        //
  double rider_mass;      // kg      0 without a rider
  double rider_place[3];  // m       rider's centre of mass from the rear hub, at offset zero
  double total_mass;      // kg
} bike_model;

// Checks the bicycle and lumps its parts. Errors: those of bike_check. All numbers of a model are
// finite.
BIKE_API int bike_model_init(bike_model *out, const bike_bicycle *bicycle);

#endif
