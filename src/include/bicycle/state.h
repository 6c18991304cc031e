// SPDX-License-Identifier: Apache-2.0
// The bicycle at one instant: geometry, accelerations, energy, and the forces of the ground.
//
// Signs (ISO 8855): lean right positive, steer LEFT positive, yaw left positive; the rider offset
// is right positive. The speed is that of the rear contact point along its track (the paper's v),
// not the hub's and not the radius times the wheel's rate.
#ifndef BICYCLE_STATE_H
#define BICYCLE_STATE_H

#include <bicycle/model.h>

// rad  100 turns: a lean or a steer beyond is a mistake. NOT_FINITE for it, as for what is beyond
// BIKE_LARGEST.
#define BIKE_LARGEST_ANGLE 628.31853071795865

// The two plus three variables of the paper: kappa, phi, kappa', phi', v.
typedef struct bike_state {
  double lean;       // rad    kappa
  double steer;      // rad    phi
  double lean_rate;  // rad/s
  double steer_rate; // rad/s
  double speed;      // m/s    v
} bike_state;

// What acts on the bicycle from outside, and how the rider moves. All zero: hands off, at rest.
typedef struct bike_input {
  double steer_torque;       // N m     M_S on the front system about the upward steering axis
  double roll_torque;        // N m     on the rear frame about its heading e_R
  double rider_offset;       // m       w, to the right of the place in the file
  double rider_velocity;     // m/s     w'
  double rider_acceleration; // m/s^2   w''
} bike_input;

typedef struct bike_acceleration {
  double lean;  // rad/s^2  kappa''
  double steer; // rad/s^2  phi''
  double speed; // m/s^2    v'
} bike_acceleration;

// Everything there is to know of an instant. Vectors of force are (along e_R: the rear wheel's
// heading, horizontal to the left of it, up).
typedef struct bike_snapshot {
  bike_acceleration acceleration; //
  double pitch;                   // rad    tilt - beta_r: nose down positive
  double beta_r, beta_f;          // rad    equations (1), (4)
  double psi;                     // rad    lean of the front wheel, equation (2)
  double phi_tilde;               // rad    steer projected on the ground, equation (3)
  double T_r, T_f, Z_0;           // m      equations (5)-(7)
  double yaw_rate;                // rad/s  Omega, equation (13)
  double pitch_rate;              // rad/s
  double front_speed;        // m/s    v_f of the front contact point along its track, equation (14)
  double rear_wheel_rate;    // rad/s  hinge rate relative to the frame, rolling forward positive
  double front_wheel_rate;   // rad/s  hinge rate relative to the fork
  double yaw_acceleration;   // rad/s^2
  double pitch_acceleration; // rad/s^2
  double rear_wheel_acceleration;  // rad/s^2
  double front_wheel_acceleration; // rad/s^2
  double kinetic;                  // J      equation (24)
  double potential;                // J      zero with every mass at the ground
  double power;          // W      of steer torque, damper, roll torque and the rider's motion
  double rear_force[3];  // N      of the ground on the rear wheel
  double front_force[3]; // N      of the ground on the front wheel
} bike_snapshot;

// Accelerations alone. Errors, in this order: NOT_FINITE (a number of the state or the input is not
// finite, beyond BIKE_LARGEST, or an angle beyond BIKE_LARGEST_ANGLE), NO_RIDER (a rider input
// without a rider), GEOMETRY, SINGULAR; the output is untouched then. Where the code is 0 every
// number of the result is finite. bike_accelerate, bike_rates_of and bike_evaluate return the same
// code for the same state.
BIKE_API int bike_accelerate(bike_acceleration *out, const bike_model *model,
                             const bike_state *state, const bike_input *input);

// The whole instant; same errors.
BIKE_API int bike_evaluate(bike_snapshot *out, const bike_model *model, const bike_state *state,
                           const bike_input *input);

// Mass matrix of Kane's equations for the speeds (lean_rate, steer_rate, speed): row-major, SI.
// With rates r = (lean_rate, steer_rate, speed) the kinetic energy is r.M r / 2 for a rider at
// rest. Same errors.
BIKE_API int bike_mass_matrix(double out[9], const bike_model *model, const bike_state *state,
                              double rider_offset);

// The height of the ground contact is kept by the geometry; where a motion lies relative to it is
// the integral of these rates. Heading yaw = 0 is +x.
typedef struct bike_rates {
  bike_acceleration acceleration; //
  double yaw;                     // rad/s
  double rear_angle, front_angle; // rad/s  of the wheels' hinges
  double power;                   // W      as in bike_snapshot
} bike_rates;

// Right-hand side of a ride: accelerations and the rates of what is only integrated. Same errors.
BIKE_API int bike_rates_of(bike_rates *out, const bike_model *model, const bike_state *state,
                           const bike_input *input);

#endif
