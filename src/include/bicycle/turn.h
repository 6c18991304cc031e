// SPDX-License-Identifier: Apache-2.0
// Stationary motion: the bicycle rides a circle with lean, steer and speed constant.
//
// Source: section 4 of Franke, Suhr, Riess (1990), equation (26), figure 2; for hands-free circles
// also Basu-Mandal, Chatterjee, Papadopoulos, Proc. R. Soc. A 463 (2007).
//
// Lean and steer accelerations vanish: two equations (v' = 0 follows) in speed, lean, steer and the
// rider's offset. Two of the four given leave isolated solutions, one given leaves branches. A
// steer torque is a constant of the question. Signs as in bicycle/state.h.
#ifndef BICYCLE_TURN_H
#define BICYCLE_TURN_H

#include <bicycle/stability.h>

typedef enum bike_turn_variable {
  BIKE_TURN_SPEED,  // m/s
  BIKE_TURN_LEAN,   // rad
  BIKE_TURN_STEER,  // rad
  BIKE_TURN_OFFSET, // m    the rider's
  BIKE_TURN_VARIABLES
} bike_turn_variable;

// What is special about a point of a branch.
typedef enum bike_turn_mark {
  BIKE_TURN_PLAIN,    // nothing
  BIKE_TURN_LARGEST,  // fold: `fold` is largest here, and two solutions meet and end
  BIKE_TURN_SMALLEST, // fold: `fold` is smallest here
  BIKE_TURN_STATIC,   // the branch ends at speed zero
  BIKE_TURN_STRAIGHT  // the branch meets straight riding: at a capsize speed. Also of a solution:
                      // riding straight at that speed, see below
} bike_turn_mark;

typedef struct bike_turn {
  double lean, steer;               // rad
  double speed;                     // m/s
  double rider_offset;              // m      right of the file's place
  double steer_torque;              // N m
  double yaw_rate;                  // rad/s
  double radius;                    // m      of the rear contact's circle; infinite when straight
  double eps_max;                   // 1/s    largest real part of an eigenvalue; < 0: self-stable
  bike_eigenvalues eigenvalues;     //        at constant energy, as bike_linearize
  double rear_normal, front_normal; // N  a wheel that is pulled on (< 0) has lifted: outside the
                                    //    model
  double rear_friction, front_friction; // horizontal / normal force that the ground must hold
  double residual;         // rad/s^2 largest acceleration left at these numbers, the speed's over
                           //         the length unit
  bool main_family;        //        see below
  bike_turn_mark mark;     //
  bike_turn_variable fold; //        of LARGEST and SMALLEST
} bike_turn;

// The main family is what the paper's figure 2 shows: straight riding is reached from the turn by
// moving the rider at constant speed, or along hands-free circles (offset zero). Without a rider:
// the branch nearest to upright. Other families lean and steer far, mostly with friction near 1 and
// beyond, and end without meeting straight riding.

typedef struct bike_turn_def {
  bool given[BIKE_TURN_VARIABLES];   // one or two of them
  double value[BIKE_TURN_VARIABLES]; // of those given; speed >= 0
  double steer_torque;               // N m
  // Where solutions are looked for: magnitudes.
  double lean_limit;   // rad  > 0, < pi/2
  double steer_limit;  // rad  > 0, < pi; the geometry ends earlier
  double offset_limit; // m    0: by the bicycle's size, bike_turn_limits
  double speed_limit;  // m/s  0: likewise
} bike_turn_def;

enum { BIKE_MAX_TURNS = 64 };

typedef struct bike_turns {
  int count;                       // solutions; 0 where only one variable is given
  bike_turn turns[BIKE_MAX_TURNS]; // the main family first, in rising order of lean, then of steer
  int mark_count;                  // folds and ends of the branches on which they lie
  bike_turn marks[BIKE_MAX_TURNS]; // in the same order
  int branch_count;                // branches traced
  bool straight;   // riding straight and upright, at whatever speed, answers the question too
  double residual; // where NO_CONVERGENCE: the accelerations, rad/s^2, that could not be removed
} bike_turns;

// Nothing given, no torque; the whole range: lean to 80 deg, steer to 130 deg, offsets and speeds
// by the bicycle's size.
BIKE_API bike_turn_def bike_default_turn_def(void);

// A length to measure a bicycle's by, m: 1 where the reach of the model is 1 m to 4 m, as that of
// all bicycles that people ride, 4^k where it is 4^k times that.
BIKE_API double bike_length_unit(const bike_model *model);

// `def` with the limits that 0 stands for: offsets to 1 m and speeds to 50 m/s where the length
// unit is 1 m; offsets to 4^k m and speeds to 2^k 50 m/s, those of the similar bicycle, where it is
// 4^k m.
BIKE_API bike_turn_def bike_turn_limits(const bike_turn_def *def, const bike_model *model);

// All stationary motions within the limits that have what is given.
//
// With speed given the branches are those of that speed, otherwise those of the rider offset given,
// or, without a rider, of offset zero; `marks` holds their folds in the other given variable (in
// all three others where one is given), static ends, and meetings with straight riding. With lean
// and steer, or one of these alone, see below. Every branch that crosses a grid of 2.5 deg in lean
// and steer is found and traced; a closed one smaller than a mesh may be missed.
// Lean and steer given: solved in closed form (a cubic in the offset); no branch, no marks.
// Lean or steer alone is no question: BIKE_ERROR_ARGUMENT.
//
// At a capsize speed hands-free turns branch off riding straight, one to each side, at speeds below
// it or above: three solutions meet. Within 1e-11 of that speed, where the turns would lean by less
// than 1e-5 rad, riding straight is the only one of them returned, marked BIKE_TURN_STRAIGHT: one
// of its eigenvalues is zero but for rounding, so that nothing decides between the three.
//
// Errors: ARGUMENT, NOT_FINITE, NO_RIDER (an offset other than zero, or one asked for by leaving it
// out, without a rider), NO_CONVERGENCE with `residual`, MEMORY, FULL where there are more
// solutions, marks or branches than BIKE_MAX_TURNS, or branches so long that the search, which has
// a bound on its work, was given up. No solution is count = 0, not an error.
BIKE_API int bike_turns_find(bike_turns *out, const bike_model *model, const bike_turn_def *def);

// The one solution near `from`, a solution of a neighbouring question: two variables are given.
// For sweeps over a plane, as in figure 2. NO_CONVERGENCE where Newton's method does not end near
// it; out->residual then tells what was left.
BIKE_API int bike_turn_near(bike_turn *out, const bike_model *model, const bike_turn_def *def,
                            const bike_turn *from);

// "speed", "lean", "steer", "rider_offset".
BIKE_API const char *bike_turn_variable_string(bike_turn_variable variable);

#endif
