// SPDX-License-Identifier: Apache-2.0
// Rolling without slipping for thin discs, exact, in any MuJoCo 2.2 model.
//
// MuJoCo has no velocity constraints: wheels on its contacts creep. Here each marked disc touches
// the ground in one point whose velocity is zero: three constraints a disc, solved together in
// mjcb_control, where every force of MuJoCo's forward pass is known, and added to qfrc_passive as
// generalised forces. The constraint is kept on the level of accelerations and pulled back to the
// ground at 5 rad/s (Baumgarte), so that integration errors do not pile up.
//
// The model says what rolls, in up to three tuples:
//
//   <custom>
//     <tuple name="rolling_discs">                              thin discs
//       <element objtype="geom" objname="slope"/>               a plane: ground of what follows
//       <element objtype="body" objname="rear_wheel" prm="0.3"/>      prm: the radius, m
//       <element objtype="geom" objname="front_rim"/>           prm 0: the geom's own radius
//     </tuple>
//     <tuple name="rolling_skates">                             blades: what turns not, but glides
//       <element objtype="site" objname="blade"/>               prm: rocker radius, 0: a point
//     </tuple>
//     <tuple name="rolling_driven">                             joints with a prescribed motion
//       <element objtype="joint" objname="rider" prm="0"/>      prm: address in userdata
//     </tuple>
//     <numeric name="driven:rider" data="0  0.02 2 0"/>         or: offset, amplitude, rad/s, phase
//   </custom>
//
// Discs. A body turns about its last joint, a hinge, with its centre in the body's origin; radius 0
// is that of its only cylinder, sphere or ellipsoid. A geom or site has its centre in its own
// origin and turns about the same hinge or, where there is none (a free body), about its own z
// axis. A marked wheel's geoms need no contacts with the ground (contype="0" conaffinity="0").
// Skates. A geom or site, whose z axis is square to the blade: the lowest point stays on the ground
// and does not move along that axis (as seen in the ground); it glides freely along the blade.
// Ground. The plane z = 0, or a plane geom of any height and tilt that does not move.
// Driven joints. A slide or hinge whose qpos follows w(t) exactly. w is the sum of sines
// offset + amplitude sin(omega t + phase) + ..., or w, w', w'' stand in userdata[prm..prm+2], put
// there by the host's own mjcb_control (installed before this one) for d->time, stage by stage.
// Force and power: roll_drives. Work: the activation of an actuator
// <general name="rolling:JOINT:work" joint="JOINT" dyntype="user" gainprm="0"/>, integrated by
// MuJoCo with the motion (exact while MuJoCo has no constraints of its own; a warning otherwise).
//
// Names. No other tuple, numeric or text may have a name that begins with "rolling_", no numeric
// "driven:JOINT" and no actuator "rolling:JOINT:work" may name a joint that is not driven: a slip
// of the pen would be passed over in silence.
//
// Sensors:  <user name="rolling:NAME:QUANTITY" objtype= objname= datatype="real" dim=
// needstage="acc"/>, where NAME
// is a disc, skate or driven joint and the object any at all (MuJoCo wants one). Quantities of
// discs and skates: force, point, slip (3), normal, height, height_rate, lift (1: it would lift
// off, else 0); of driven joints: force, power, error; of the whole model, NAME being "model" and
// tuples not needed: energy, potential, kinetic, J. One sensor of what rolls also makes force and
// torque sensors, cfrc_int and cfrc_ext see the forces of the ground.
//
// What one must know
// - Units are SI and radians; vectors are in the world frame; forces act ON the wheel.
// - Exact under RK4: order 4 with slides and hinges as root, 2 with a free joint (that is MuJoCo's
//   order for quaternions). Euler and implicit integrate with order 1 and treat some forces after
//   the solve: at 1 ms a bicycle's wheels then slip by 1e-3 m/s.
// - Controls changed between mj_step1 and mj_step2 are seen too late: use mj_step, or set controls
//   in an mjcb_control of your own, installed before this one.
// - Joint limits, friction loss, equalities and contacts of other geoms are exact, for every solver
//   as far as its tolerance goes, with a dense and with a sparse Jacobian.
// - Force and torque sensors, cfrc_int and cfrc_ext see the ground's forces if the model has a user
//   sensor at stage acc (MuJoCo calls mjcb_sensor for those alone); else a warning says so, once.
// - mj_inverse does not call mjcb_control: its qfrc_inverse holds the forces of ground and drives
//   beside the applied ones.
// - Where constraints repeat each other (two discs on one axle) the accelerations are exact and the
//   forces reported are the smallest possible ones; a warning says so, once.
// - The state at the start must satisfy the constraints: roll_project. A warning is given, once,
//   for a wheel 1 % of its radius off the ground or as much off its velocity.
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
  X(ROLL_NO_MARKER, "the model has no tuple 'rolling_discs', 'rolling_skates', 'rolling_driven'")  \
  X(ROLL_BAD_NAME, "a custom element's name begins with 'rolling_' but is none of the tuples "     \
                   "rolling_discs, rolling_skates, rolling_driven")                                \
  X(ROLL_BAD_OBJECT, "rolling_discs: an element is no body, geom or site")                         \
  X(ROLL_BAD_SKATE, "rolling_skates: an element is no geom or site")                               \
  X(ROLL_BAD_JOINT, "rolling_driven: an element is no slide or hinge joint")                       \
  X(ROLL_BAD_RADIUS, "rolling discs: a radius (prm, or the geom's) is not a positive number")      \
  X(ROLL_BAD_GROUND, "rolling discs: the ground's plane belongs to a body that can move")          \
  X(ROLL_BAD_DRIVE, "rolling_driven: a joint's motion is neither in a numeric 'driven:JOINT' "     \
                    "(offset, then amplitude, rad/s, phase) nor in three userdata from prm on")    \
  X(ROLL_NOT_DRIVEN, "a numeric 'driven:JOINT' names no joint of the tuple rolling_driven")        \
  X(ROLL_BAD_ACTUATOR, "an actuator 'rolling:JOINT:work' names no joint of the tuple "             \
                       "rolling_driven, or its dyntype is not user")                               \
  X(ROLL_BAD_SENSOR, "a sensor 'rolling:NAME:QUANTITY' names nothing that rolls, has a wrong "     \
                     "dimension or does not need stage acc")                                       \
  X(ROLL_FIXED_BODY, "rolling discs: a disc belongs to a body that cannot move")                   \
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

// Number of marked discs and skates, rolling or not.
ROLL_API int roll_disc_count(const mjModel *m);

// Number of marked driven joints, driven or not.
ROLL_API int roll_drive_count(const mjModel *m);

// An element of a model.
typedef struct roll_object {
  int type; // an mjtObj; mjOBJ_UNKNOWN: none
  int id;
} roll_object;

// Checks what the model says to this library: names of custom elements, discs, skates, driven
// joints with their motions and actuators, sensors. The first error found and, where `where` is not
// NULL, what it is in: a tuple, numeric or text, the body, geom, site or joint that is marked, an
// actuator or a sensor. ROLL_NO_MARKER for a model without any of the tuples.
ROLL_API roll_error roll_check(roll_object *where, const mjModel *m);

// An error and what it is in as one line of at most size - 1 bytes, such as
// "rolling_discs: the last joint of a disc's body is not a hinge (body 'wheel')". Returns `text`.
ROLL_API const char *roll_fault_string(char *text, int size, roll_error error, roll_object where,
                                       const mjModel *m);

//---------------------------------- what the discs do ---------------------------------------------

typedef struct roll_disc {
  const char *name;    //     name of the body, geom or site, of the mjModel; "" without one
  roll_error error;    //     why this disc does not roll, else ROLL_OK; then all below is 0
  int body;            //     id of the wheel's body
  mjtNum radius;       //     m
  mjtNum point[3];     // 3x1 point of the disc nearest to the ground, world, m
  mjtNum force[3];     // 3x1 force of the ground on the wheel, world, N
  mjtNum normal_force; //     its part along the ground's normal, N; < 0: the wheel would lift
  int lifts;           //     1 if normal_force < 0: the ground would have to pull
  mjtNum slip[3];      // 3x1 velocity of the wheel's material at the point, along the ground, m/s;
                       //     of a skate its sideways part
  mjtNum height;       //     of the point above the ground, m; 0 when exact
  mjtNum height_rate;  //     its rate, m/s; 0 when exact
} roll_disc;

// Fills discs[0..count-1], count <= roll_disc_count(m), discs before skates, in the order of the
// tuples, for the moment of the last mj_forward (after mj_step call mj_forward first: MuJoCo's
// derived quantities belong to the start of the step). `d` is left as it was. Returns the first
// error of a disc, or ROLL_NO_MARKER, ROLL_NO_STACK.
ROLL_API roll_error roll_discs(roll_disc *discs, int count, const mjModel *m, mjData *d);

typedef struct roll_drive {
  const char *name; //     name of the joint
  roll_error error; //     why it is not driven, else ROLL_OK; then all below is 0
  int joint;        //     its id
  mjtNum motion[3]; // 3x1 prescribed coordinate w and its two derivatives (m or rad, s)
  mjtNum off;       //     qpos - w; 0 when exact
  mjtNum rate_off;  //     qvel - w'; 0 when exact
  mjtNum force;     //     of the drive, along the joint, N or N m
  mjtNum power;     //     force times qvel, W: what it gives to the model
} roll_drive;

// The same for the driven joints.
ROLL_API roll_error roll_drives(roll_drive *drives, int count, const mjModel *m, mjData *d);

//---------------------------------- the constraint ------------------------------------------------

// A wheel this part of its radius off the ground, or off its velocity by as much in the time in
// which errors decay (1/ROLL_DECAY s), was put there: no integration error comes near it.
#define ROLL_OFF_SHARE 0.01
#define ROLL_DECAY 5.0 // rad/s of Baumgarte's gains, critically damped

// The callback: an mjcb_control. Calls the one that roll_install found, then makes the discs roll.
// Returns at once for a model without the tuples.
ROLL_API void roll_control(const mjModel *m, mjData *d);

// An mjcb_sensor: user sensors, and force sensors, cfrc_int and cfrc_ext with the ground's forces.
ROLL_API void roll_sensor(const mjModel *m, mjData *d, int stage);

// An mjcb_act_dyn: the power of a drive as the rate of its work; other actuators go to the callback
// that roll_install found.
ROLL_API mjtNum roll_act_dyn(const mjModel *m, const mjData *d, int id);

// Sets mjcb_control, mjcb_sensor and mjcb_act_dyn, keeping callbacks found there to be called
// first. Again: no effect. When a host has replaced one meanwhile, its callback is now the one
// kept: it must not call ours.
ROLL_API void roll_install(void);

// Puts back the callbacks that roll_install found. ROLL_NOT_INSTALLED, and no change, where
// mjcb_control is another one.
ROLL_API roll_error roll_uninstall(void);

// 1 while mjcb_control is roll_control: a host that sets mjcb_control later removes ours silently.
ROLL_API int roll_is_installed(void);

// Makes the state consistent with the constraints: positions by Newton's method on the heights and
// driven joints, then velocities, both by the change that is smallest in the metric of the mass
// matrix. That keeps what fits (a lean rate with the hub velocity that belongs to it) and spreads
// what does not over all coordinates. Ends with mj_forward; heights (m) and contact velocities
// (m/s), as shares of 1 + the largest |qpos| and |qvel|, are then below 1e-13. On an error qpos and
// qvel are as they were, and derived quantities need an mj_forward.
ROLL_API roll_error roll_project(const mjModel *m, mjData *d);

#ifdef __cplusplus
}
#endif

#endif
