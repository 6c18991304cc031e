// SPDX-License-Identifier: Apache-2.0
// What the files of the rolling library share; not for users.
#ifndef ROLL_ROLLING_INTERNAL_H
#define ROLL_ROLLING_INTERNAL_H

#include "rolling.h"

//---------------------------------- the marker (rolling_marker.c) ---------------------------------

typedef struct roll_marker {
  int first; // address of the first element in m->tuple_obj*
  int count; // number of elements; 0 without a marker
} roll_marker;

typedef struct roll_wheel {
  int body;      // id of the body the disc is part of
  int geom;      // id of the geom whose origin is the hub; -1: the body's origin is
  int hinge;     // id of the joint that is the axle; -1: the geom's z axis is
  mjtNum radius; // m
} roll_wheel;

// The plane the discs roll on; it does not move.
typedef struct roll_plane {
  mjtNum origin[3]; // 3x1 a point of it, world, m
  mjtNum normal[3]; // 3x1 unit, upwards
} roll_plane;

roll_marker roll_find_marker(const mjModel *m);
roll_error roll_read_wheel(roll_wheel *wheel, const mjModel *m, int address);
const roll_plane *roll_ground(void);

//---------------------------------- one contact (rolling_contact.c) -------------------------------

typedef struct roll_contact {
  roll_error error;     //     why the disc does not roll; then nothing below is set
  int row;              //     its first row in the system
  int body;             //     id of the wheel's body
  mjtNum radius;        //     R, m
  mjtNum axle[3];       // 3x1 n, unit
  mjtNum down[3];       // 3x1 e, unit: from the hub to the contact point
  mjtNum sine;          //     s, sine of the angle between axle and ground normal
  mjtNum cosine;        //     its cosine, n.u
  mjtNum point[3];      // 3x1 p, world, m
  mjtNum height;        //     g, m
  mjtNum velocity[3];   // 3x1 of the wheel's material at the point, J qvel, m/s
  mjtNum convective[3]; // 3x1 Jdot qvel, m/s^2
} roll_contact;

// Position part. Needs mj_kinematics.
roll_error roll_place_contact(roll_contact *contact, const roll_wheel *wheel, const mjData *d);

// Velocity part. Needs mj_comPos and mj_comVel.
void roll_move_contact(roll_contact *contact, const mjModel *m, const mjData *d);

//---------------------------------- semidefinite systems (rolling_cholesky.c) ---------------------

// A = L L^T of an n x n semidefinite A, and what the least-norm solution needs if its rank is less.
typedef struct roll_factor {
  int n;
  int rank;
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

//---------------------------------- all contacts (rolling_system.c) -------------------------------

typedef struct roll_system {
  int nv;                // m->nv
  int discs;             // number of marked discs
  int rows;              // 3 for each disc that rolls at this moment: world x, y, z
  roll_contact *contact; // discs
  mjtNum *J;             // rows x nv: velocity of the wheels' material at the contact points
  mjtNum *Y;             // rows x nv: J M^-1/2, so that J M^-1 J^T = Y Y^T
  mjtNum *target;        // rows: demanded J qacc, m/s^2
  mjtNum *lambda;        // rows: forces on the wheels, N
  mjtNum *row_work;      // rows: scratch
  mjtNum *dof_work;      // nv: scratch
  roll_factor A;         // of J M^-1 J^T
} roll_system;

// Takes the memory from d's stack (mjMARKSTACK and mjFREESTACK are the caller's). Positions only.
// ROLL_NO_STACK leaves an empty system; any other error is that of the first disc that does not
// roll.
roll_error roll_build_system(roll_system *s, const mjModel *m, mjData *d);

// Factor of J M^-1 J^T from Y.
void roll_factor_system(roll_system *s);

// a (rows) = J M^-1 f, f a generalised force (nv); overwrites dof_work (f may be it).
void roll_map_force(mjtNum *a, roll_system *s, const mjtNum *f, const mjModel *m, mjData *d);

// dof_work = M^-1 J^T A^+ a: the smallest change of qacc (or qvel) that changes J qacc by a (rows).
void roll_find_change(roll_system *s, const mjtNum *a, const mjModel *m, mjData *d);

// Velocities: velocity, convective and target of every contact.
void roll_set_target(roll_system *s, const mjModel *m, const mjData *d);

// lambda such that M qacc = f + J^T lambda gives J qacc = target, f being the sum of MuJoCo's
// forces with d->qfrc_passive as it stands.
void roll_set_lambda(roll_system *s, const mjModel *m, mjData *d);

//---------------------------------- MuJoCo's own solver rows (rolling_solver.c) -------------------

// 1 if MuJoCo's solver has rows that can be made to respect the discs.
int roll_has_solver_rows(const mjModel *m, const mjData *d);

// Rebuilds MuJoCo's rows as they are without discs. Before the system takes stack.
void roll_reset_solver_rows(const mjModel *m, mjData *d);

// Makes the rows respect the discs; adds to `reaction` (rows x 1, may be NULL) the contact forces
// that the rows' present forces call for.
void roll_project_solver_rows(mjtNum *reaction, roll_system *s, const mjModel *m, mjData *d);

//---------------------------------- messages (rolling_error.c) ------------------------------------

typedef enum roll_message {
  ROLL_SAY_DISC,
  ROLL_SAY_SPARSE,
  ROLL_SAY_SENSOR,
  ROLL_MESSAGES
} roll_message;

// mju_warning, once in the life of the program for each message, never before the second step.
void roll_warn(roll_message message, const char *text, const mjModel *m, const mjData *d);

#endif
