// SPDX-License-Identifier: Apache-2.0
// Oracle: the kinematics (8)-(14) and the momenta (15)-(17) of the paper, corrected.
//
// Corrections to the printed equations: (9) and (10) gain T_r' e_R and T_r'' e_R, (12) gains
// - T_f phi_tilde' e_z x e_R^f, (13) has the dot on phi_tilde and T_r in its denominator.
// Generalised from the paper's axial inertias to a full tensor for each part, no part lumped.
// Vectors have components along the moving basis (e_N, e_R, e_A) = (right, heading, up in the rear
// wheel's plane); the origin is where the steering axis meets the ground.
#ifndef BICYCLE_TESTS_PAPER_MOTION_H
#define BICYCLE_TESTS_PAPER_MOTION_H

#include "paper_geometry.h"
#include "vectors.h"
#include <bicycle/state.h>

// The second derivatives that the equations of motion determine.
typedef struct paper_acceleration {
  real phi, kappa, v;
} paper_acceleration;

typedef struct paper_part {
  real mass;            // kg
  bool front;           // belongs to the steering system
  vec place;            // m         x of (8)
  vec velocity;         // m/s       x' of (9)
  vec acceleration;     // m/s^2     x'' of (10)
  vec derived;          // m/s^2     x'' as the derivative of (9): must equal `acceleration`
  vec angular_velocity; // rad/s
  vec angular_momentum; // kg m^2/s  L about the centre of mass
  vec torque;           // N m       L'
} paper_part;

typedef struct paper_motion {
  paper_pose pose;
  real tilt;                   // rad    upright beta_r
  jet yaw_rate;                // rad/s  Omega, (13)
  jet front_speed;             // m/s    v_f, (14)
  jet rear_wheel, front_wheel; // rad/s  rates of the hinges, rolling forward positive
  vec e_S, e_z, e_R_front, e_N_front;
  vec T_f, T_r;           // m      contact points
  vec front_contact_rate; // m/s    (12): must be v_f e_R^f - v e_R
  int part_count;
  paper_part part[BIKE_MAX_PARTS];
} paper_motion;

// Roots of (4) upright and at a state; found once, then used for any accelerations.
typedef struct paper_roots {
  real upright, here; // rad
} paper_roots;

// False where there is no geometry connected with the upright position.
bool paper_roots_of(paper_roots *out, const bike_geometry *geometry, const bike_state *state);

// Motion of the bicycle if it had these accelerations.
paper_motion paper_motion_of(const bike_bicycle *bicycle, const paper_roots *roots,
                             const bike_state *state, const bike_input *input,
                             paper_acceleration acceleration);

// Kinetic and potential energy (24), and the rate of their sum (the power of all that acts).
real paper_kinetic(const paper_motion *motion);
real paper_potential(const paper_motion *motion, real gravity);
real paper_energy_rate(const paper_motion *motion, real gravity);

#endif
