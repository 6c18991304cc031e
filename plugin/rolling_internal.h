// SPDX-License-Identifier: Apache-2.0
// What the files of the rolling library share; not for users.
#ifndef ROLL_ROLLING_INTERNAL_H
#define ROLL_ROLLING_INTERNAL_H

#include "rolling.h"

//---------------------------------- the marker (rolling_marker.c) ---------------------------------

// Elements of one tuple.
typedef struct roll_span {
  int first; // address of the first element in m->tuple_obj*
  int count; // number of elements; 0 without the tuple
} roll_span;

typedef struct roll_marker {
  roll_span discs, skates, driven;
} roll_marker;

// What the name of a custom element says.
typedef enum roll_kind {
  ROLL_KIND_FOREIGN, // nothing to this library
  ROLL_KIND_DISCS,
  ROLL_KIND_SKATES,
  ROLL_KIND_DRIVEN,
  ROLL_KIND_UNKNOWN // "rolling_" and a word that means nothing
} roll_kind;

roll_kind roll_kind_of(const char *name);

typedef struct roll_wheel {
  int body;      // id of the body the disc is part of
  int objtype;   // of what marks it: mjOBJ_BODY, mjOBJ_GEOM or mjOBJ_SITE; its origin is the hub
  int objid;     // id of that
  int hinge;     // id of the joint that is the axle; -1: the z axis of the geom or site is
  int skate;     // 1: a blade, which glides along itself
  mjtNum radius; // m; 0 for a blade in one point
} roll_wheel;

// The plane the discs roll on; it does not move.
typedef struct roll_plane {
  mjtNum origin[3]; // 3x1 a point of it, world, m
  mjtNum normal[3]; // 3x1 unit, upwards
} roll_plane;

roll_marker roll_find_marker(const mjModel *m);
int roll_is_marked(const roll_marker *marker);

// 1 if an element is a plane, the ground of those after it.
int roll_is_ground(const mjModel *m, int address);

// Discs or skates in a span: all elements but planes.
int roll_count_wheels(const mjModel *m, roll_span span);

// A disc or skate on the plane of a geom; ground -1 is the floor z = 0.
roll_error roll_read_wheel(roll_wheel *wheel, const mjModel *m, int address, int ground, int skate);
roll_plane roll_read_ground(const mjData *d, int ground);

// What an error of a disc or skate is in: its element, or the plane.
roll_object roll_wheel_fault(roll_error error, const mjModel *m, int address, int ground);

// What an element marks, and its name; "" without one.
roll_object roll_element(const mjModel *m, int address);
const char *roll_element_name(const mjModel *m, int address);

//---------------------------------- before it is run (rolling_check.c) ----------------------------

// ROLL_BAD_NAME for a custom element that looks like a marker and is none: it would be passed over.
roll_error roll_check_names(roll_object *where, const mjModel *m);

//---------------------------------- one contact (rolling_contact.c) -------------------------------

typedef struct roll_contact {
  roll_error error;        //     why the disc does not roll; then nothing below is set
  int address;             //     of its element in the tuples (always set)
  int row;                 //     its first row in the system
  int rows;                //     3 for a disc, along world x, y, z; 2 for a skate
  int skate;               //     1: a blade
  int body;                //     id of the wheel's body
  roll_plane ground;       //     u, ground normal
  mjtNum radius;           //     R, m
  mjtNum axle[3];          // 3x1 n, unit
  mjtNum down[3];          // 3x1 e, unit: from the hub to the contact point
  mjtNum sine;             //     s, sine of the angle between axle and ground normal
  mjtNum cosine;           //     its cosine, n.u
  mjtNum point[3];         // 3x1 p, world, m
  mjtNum height;           //     g, m
  mjtNum direction[3][3];  // 3x1 of each row, unit: the row is the velocity along it
  mjtNum velocity[3];      // 3x1 of the wheel's material at the point, m/s
  mjtNum convective[3];    // 3x1 its rate for qacc = 0, m/s^2
  mjtNum sideways_rate[3]; // 3x1 rate of a blade's sideways direction, 1/s
} roll_contact;

// Position part, on the plane of a geom or (-1) the floor. Needs mj_kinematics.
roll_error roll_place_contact(roll_contact *contact, const roll_wheel *wheel, int ground,
                              const mjData *d);

// Velocity part. Needs mj_comPos and mj_comVel.
void roll_move_contact(roll_contact *contact, const mjModel *m, const mjData *d);

// Part along the ground's normal of each of the contact's rows.
mjtNum roll_upward(const roll_contact *contact, int row);

//---------------------------------- one driven joint (rolling_drive.c) ----------------------------

typedef struct roll_motion {
  roll_error error; //     why the joint is not driven; then nothing below is set
  int address;      //     of its element in the tuples (always set)
  int row;          //     its row in the system
  int joint, dof;   //     ids
  mjtNum wanted[3]; // 3x1 w and its two derivatives
  mjtNum off;       //     qpos - w
} roll_motion;

// What is wrong with an element of rolling_driven.
roll_error roll_check_drive(const mjModel *m, int address);

// ROLL_NOT_DRIVEN for a numeric "driven:JOINT" that gives its motion to no joint.
roll_error roll_check_motions(roll_object *where, const mjModel *m);

// Prescribed motion at d->time, and the joint's distance from it.
roll_error roll_read_motion(roll_motion *motion, const mjModel *m, const mjData *d);

//---------------------------------- semidefinite systems (rolling_cholesky.c) ---------------------

// A = L L^T of an n x n semidefinite A, and what the least-norm solution needs if its rank is less.
typedef struct roll_factor {
  int n;
  int rank;
  int repeated;    // rows that say again what those before them say
  int *pivot;      // n: scratch
  mjtNum *L;       // n x n, row-major: first A, then its factor in the first `rank` columns
  mjtNum *G;       // n x n: factor of L^T L (rank x rank, packed), only if rank < n
  mjtNum *inverse; // n: of the diagonal of L, or of G if rank < n
  mjtNum *work;    // n: scratch
} roll_factor;

// Replaces the matrix in f->L by its factor.
void roll_factorise(roll_factor *f);

// x = A^+ b (least squares, least norm); x may be b.
void roll_solve(mjtNum *x, const roll_factor *f, const mjtNum *b);

//---------------------------------- all constraints (rolling_system.c) ----------------------------

typedef struct roll_system {
  int nv;                // m->nv
  int contacts;          // number of marked discs and skates
  int motions;           // number of marked driven joints
  int rows;              // of those that hold at this moment
  roll_error error;      // of the first that does not, but for ROLL_NO_STACK
  roll_object fault;     // what that is in
  roll_contact *contact; // contacts
  roll_motion *motion;   // motions
  mjtNum *J;             // rows x nv: velocity at the contact points; velocity of driven joints
  mjtNum *Y;             // rows x nv: J M^-1/2, so that J M^-1 J^T = Y Y^T
  mjtNum *target;        // rows: demanded J qacc, m/s^2
  mjtNum *lambda;        // rows: forces on the wheels and driven joints, N
  mjtNum *row_work;      // rows: scratch
  mjtNum *dof_work;      // nv: scratch
  roll_factor A;         // of J M^-1 J^T
} roll_system;

// Takes the memory from d's stack (mjMARKSTACK and mjFREESTACK are the caller's). Positions only.
// ROLL_NO_STACK leaves an empty system; any other error is the first of a disc that does not roll
// or a joint that is not driven.
roll_error roll_build_system(roll_system *s, const mjModel *m, mjData *d);

// Factor of J M^-1 J^T from Y.
void roll_factor_system(roll_system *s);

// a (rows) = J M^-1 f, f a generalised force (nv); overwrites dof_work (f may be it).
void roll_map_force(mjtNum *a, roll_system *s, const mjtNum *f, const mjModel *m, mjData *d);

// dof_work = M^-1 J^T A^+ a: the smallest change of qacc (or qvel) that changes J qacc by a (rows).
void roll_find_change(roll_system *s, const mjtNum *a, const mjModel *m, mjData *d);

//---------------------------------- their dynamics (rolling_dynamics.c) ---------------------------

// Velocities: velocity, convective and target of every contact and motion.
void roll_set_target(roll_system *s, const mjModel *m, const mjData *d);

// lambda such that M qacc = f + J^T lambda gives J qacc = target, f being the sum of MuJoCo's
// forces with d->qfrc_passive as it stands.
void roll_set_lambda(roll_system *s, const mjModel *m, mjData *d);

//---------------------------------- MuJoCo's own solver rows (rolling_solver.c) -------------------

// Rebuilds MuJoCo's rows as they are without discs. Before the system takes stack.
void roll_reset_solver_rows(const mjModel *m, mjData *d);

// Makes the rows respect the discs; adds to `reaction` (rows x 1, may be NULL) the contact forces
// that the rows' present forces call for.
void roll_project_solver_rows(mjtNum *reaction, roll_system *s, const mjModel *m, mjData *d);

//---------------------------------- what they do now (rolling_report.c) ---------------------------

// The system at the present moment with all its forces in lambda, those that answer MuJoCo's own
// solver rows included. Takes stack as roll_build_system; call roll_restore after mjFREESTACK.
roll_error roll_survey(roll_system *s, const mjModel *m, mjData *d);
void roll_restore(const mjModel *m, mjData *d);

void roll_describe_disc(roll_disc *disc, const roll_system *s, int index, const mjModel *m);
void roll_describe_drive(roll_drive *drive, const roll_system *s, int index, const mjModel *m,
                         const mjData *d);

//---------------------------------- the callbacks' work -------------------------------------------

// rolling.c: adds J^T lambda to qfrc_passive and makes MuJoCo's rows respect the discs.
void roll_make_roll(const mjModel *m, mjData *d);

// rolling_sensor.c: fills user sensors; repairs cfrc_ext, cfrc_int, force and torque sensors.
void roll_sense(const mjModel *m, mjData *d);

// rolling_work.c: the rate of the activation that holds a drive's work, W; 0 for other actuators.
int roll_work_rate(mjtNum *power, const mjModel *m, mjData *d, int actuator);

// ROLL_BAD_ACTUATOR for one that would hold the work of nothing.
roll_error roll_check_actuators(roll_object *where, const mjModel *m);

//---------------------------------- messages (rolling_error.c) ------------------------------------

typedef enum roll_message {
  ROLL_SAY_NAME,
  ROLL_SAY_DISC,
  ROLL_SAY_REPEATED,
  ROLL_SAY_START,
  ROLL_SAY_SENSOR,
  ROLL_SAY_BLIND,
  ROLL_SAY_WORK,
  ROLL_MESSAGES
} roll_message;

// mju_warning, once in the life of the program for each message, never before the second step.
void roll_warn(roll_message message, const char *text, const mjModel *m, const mjData *d);

// The same of an error and what it is in.
void roll_warn_of(roll_message message, roll_error error, roll_object where, const mjModel *m,
                  const mjData *d);

//---------------------------------- names (rolling_name.c) ----------------------------------------

// Takes "rolling:NAME:QUANTITY" apart: its quantity ("" without one), and NAME with its length.
// NULL for a text that does not begin so.
const char *roll_split_name(const char **object, int *length, const char *name);

// Index of the disc or skate, or of the driven joint, with that name; -1 without.
int roll_find_wheel(const mjModel *m, const char *name, int length);
int roll_find_drive(const mjModel *m, const char *name, int length);

// What is wrong with the user sensors of the model, and the first that is.
roll_error roll_check_sensors(roll_object *where, const mjModel *m);

#endif
