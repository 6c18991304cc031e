// SPDX-License-Identifier: Apache-2.0
// Rolling without slipping for thin discs, exact, in any MuJoCo 2.2 model.
//
// MuJoCo has no velocity constraints: wheels on its contacts creep. Here each marked disc touches
// the ground in one point whose velocity is zero: three constraints a disc, solved together in
// mjcb_control, where every force of MuJoCo's forward pass is known, and added to qfrc_passive as
// generalised forces. The constraint is kept on the level of accelerations and pulled back to the
// ground at 5 rad/s (Baumgarte), so that integration errors do not pile up.
//
// The model says which discs roll:
//
//   <custom><tuple name="rolling_discs">
//     <element objtype="body" objname="rear_wheel" prm="0.3"/>     prm: the radius, m
//   </tuple></custom>
//
// A body turns about its last joint, a hinge, with its centre in the body's origin. A geom has its
// centre in its own origin and turns about the same hinge or, where there is none (a free body),
// about its own z axis. The ground is the plane z = 0. A marked wheel's geoms need no contacts with
// the ground (contype="0" conaffinity="0").
//
// What one must know
// - Units are SI and radians; vectors are in the world frame; forces act ON the wheel.
// - Exact under RK4: order 4 with slides and hinges as root, 2 with a free joint (that is MuJoCo's
//   order for quaternions). Euler and implicit integrate with order 1 and treat some forces after
//   the solve: at 1 ms a bicycle's wheels then slip by 1e-3 m/s.
// - Controls changed between mj_step1 and mj_step2 are seen too late: use mj_step, or set controls
//   in an mjcb_control of your own, installed before this one.
// - Joint limits, friction loss, equalities and contacts of other geoms are exact with a dense
//   Jacobian; with a sparse one they violate the constraint, and a warning says so, once.
// - Force and torque sensors, cfrc_int, cfrc_ext and mj_inverse do not see the ground's forces; a
//   warning says so, once, for a model with such sensors.
// - Where constraints repeat each other (two discs on one axle) the accelerations are exact and the
//   forces reported are the smallest possible ones.
// - The state at the start must satisfy the constraints: roll_project.
//
// Threads: no function keeps a state between calls; all work on the mjData they are given, scratch
// memory is that mjData's stack. Install before the threads start.
// Errors: a roll_error, 0 for success; nothing here calls mju_error. A disc that cannot roll is
// left free, with a warning through mju_warning, once, never before the second step of a simulation
// (MuJoCo's compiler takes the first).
#ifndef ROLL_ROLLING_H
#define ROLL_ROLLING_H

#include <mujoco/mujoco.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ROLL_API __attribute__((visibility("default")))

#define ROLL_ERRORS(X)                                                                             \
  X(ROLL_OK, "no error")                                                                           \
  X(ROLL_NO_MARKER, "the model has no tuple 'rolling_discs'")                                      \
  X(ROLL_BAD_OBJECT, "rolling_discs: an element is neither a body nor a geom")                     \
  X(ROLL_BAD_RADIUS, "rolling_discs: a radius (prm) is not a positive finite number")              \
  X(ROLL_FIXED_BODY, "rolling_discs: a disc belongs to a body that cannot move")                   \
  X(ROLL_NO_AXLE, "rolling_discs: the last joint of a disc's body is not a hinge")                 \
  X(ROLL_FLAT, "a rolling disc lies flat: it has no single contact point")                         \
  X(ROLL_NO_STACK, "too little mjData stack for the rolling discs: raise nstack")                  \
  X(ROLL_NOT_FINITE, "the state holds a number that is not finite")                                \
  X(ROLL_NO_CONVERGENCE, "rolling discs: no state on the ground near the given one")               \
  X(ROLL_NOT_INSTALLED, "mjcb_control is not roll_control")

typedef enum roll_error {
#define ROLL_ERROR_CODE(code, text) code,
  ROLL_ERRORS(ROLL_ERROR_CODE)
#undef ROLL_ERROR_CODE
} roll_error;

// One line of text, never NULL; owned by the library.
ROLL_API const char *roll_error_string(roll_error error);

//---------------------------------- the model -----------------------------------------------------

// Number of marked discs, rolling or not; 0 for a model without the tuple.
ROLL_API int roll_disc_count(const mjModel *m);

// Checks the marker: the first error found and, where `element` is not NULL, the disc it is in (-1:
// none). ROLL_NO_MARKER for a model without the tuple.
ROLL_API roll_error roll_check(int *element, const mjModel *m);

//---------------------------------- what the discs do ---------------------------------------------

typedef struct roll_disc {
  const char *name;    //     name of the body or geom, of the mjModel; "" without one
  roll_error error;    //     why this disc does not roll, else ROLL_OK; then all below is 0
  int body;            //     id of the wheel's body
  mjtNum radius;       //     m
  mjtNum point[3];     // 3x1 point of the disc nearest to the ground, world, m
  mjtNum force[3];     // 3x1 force of the ground on the wheel, world, N
  mjtNum normal_force; //     its part along the ground's normal, N; < 0: the wheel would lift
  mjtNum slip[3];      // 3x1 velocity of the wheel's material at the point, along the ground, m/s
  mjtNum height;       //     of the point above the ground, m; 0 when exact
  mjtNum height_rate;  //     its rate, m/s; 0 when exact
} roll_disc;

// Fills discs[0..count-1], count <= roll_disc_count(m), in the order of the tuple, for the moment
// of the last mj_forward (after mj_step call mj_forward first: MuJoCo's derived quantities belong
// to the start of the step). `d` is left as it was. Returns the first error of a disc, or
// ROLL_NO_MARKER, ROLL_NO_STACK.
ROLL_API roll_error roll_discs(roll_disc *discs, int count, const mjModel *m, mjData *d);

//---------------------------------- the constraint ------------------------------------------------

// The callback: an mjcb_control. Calls the one that roll_install found, then makes the discs roll.
// Returns at once for a model without the tuple.
ROLL_API void roll_control(const mjModel *m, mjData *d);

// Sets mjcb_control, keeping a callback found there to be called first. Again: no effect. When a
// host has replaced mjcb_control meanwhile, its callback is now the one kept: it must not call
// ours.
ROLL_API void roll_install(void);

// Puts back the callback that roll_install found. ROLL_NOT_INSTALLED, and no change, where
// mjcb_control is another one.
ROLL_API roll_error roll_uninstall(void);

// 1 while mjcb_control is roll_control: a host that sets mjcb_control later removes ours silently.
ROLL_API int roll_is_installed(void);

// Makes the state consistent with the constraints: positions by Newton's method on the heights,
// then velocities, both by the change that is smallest in the metric of the mass matrix. That keeps
// what fits (a lean rate with the hub velocity that belongs to it) and spreads what does not over
// all coordinates. Ends with mj_forward; heights (m) and contact velocities (m/s, as a share of 1 +
// the largest |qvel|) are then below 1e-13. On an error qpos and qvel are as they were, and derived
// quantities need an mj_forward.
ROLL_API roll_error roll_project(const mjModel *m, mjData *d);

#ifdef __cplusplus
}
#endif

#endif
