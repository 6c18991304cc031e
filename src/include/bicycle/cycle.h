// SPDX-License-Identifier: Apache-2.0
// The oscillation into which riding falls beyond the weave speed: a limit cycle born in a Hopf
// bifurcation, found by shooting.
//
// Source: section 4 of Franke, Suhr, Riess (1990): "just below the lower limit of the stability
// region, the instability for this oscillation is stopped by non-linear effects at a finite
// amplitude". Mirror-symmetric bicycles: after half a period the motion is its own mirror image,
// x(T/2) = -x(0) in x = (lean, steer, lean_rate, steer_rate). Energy is constant; what tells one
// motion from another is the speed at which riding straight has the same energy.
#ifndef BICYCLE_CYCLE_H
#define BICYCLE_CYCLE_H

#include <bicycle/state.h>

// The least damped oscillation of upright riding: lean = cos(w t), steer = ratio cos(w t - lag).
typedef struct bike_weave_mode {
  double growth;    // 1/s    real part of the eigenvalue
  double frequency; // rad/s  imaginary part, > 0
  double ratio;     //        steer's amplitude per lean's
  double lag; // rad    0 .. 2 pi, of steer (LEFT positive) behind lean: pi is to the same side
} bike_weave_mode;

// BIKE_ERROR_NO_CONVERGENCE where no pair of eigenvalues is complex.
BIKE_API int bike_weave_mode_at(bike_weave_mode *out, const bike_model *model, double speed);

typedef struct bike_cycle {
  double speed;      // m/s  of straight riding with the same energy
  double lean;       // rad  amplitude: the largest lean
  double steer;      // rad  amplitude
  double mean_speed; // m/s  over a period
  double period;     // s
  double ratio, lag; //      of the fundamental, as in bike_weave_mode
  double multiplier; //      largest modulus of the Floquet multipliers at constant energy, the one
                     //      of the motion along the cycle (1) left out: < 1 is a stable cycle
  double residual;   //      what is left of x(T/2) = -x(0), relative to the amplitude
  bike_state start;  //      at the largest lean
} bike_cycle;

// The cycle with a lean amplitude (rad, > 0), sought from a near one; NULL: from straight riding at
// `weave_speed`. NO_CONVERGENCE where none is found near it; errors of bike_ride.
BIKE_API int bike_cycle_find(bike_cycle *out, const bike_model *model, double lean,
                             double weave_speed, const bike_cycle *near);

// The cycle with the energy of riding straight at `speed`, to 1e-9 m/s, between two of a branch
// whose speeds it separates: `smaller` (NULL: straight riding at the weave speed) and `larger`, of
// larger lean. ARGUMENT if it does not separate them; errors of bike_cycle_find.
BIKE_API int bike_cycle_of_speed(bike_cycle *out, const bike_model *model, double speed,
                                 double weave_speed, const bike_cycle *smaller,
                                 const bike_cycle *larger);

typedef struct bike_hopf {
  double speed;         // m/s        the weave speed
  bike_weave_mode mode; //            there
  double unstable_side; //            -1: straight riding weaves below the speed, +1: above
  double curvature;     // m/s/rad^2  (speed of the cycle - weave speed)/lean^2 for small lean
  bool supercritical;   //            cycles are born on the unstable side, and are stable unless
                        //            another mode is unstable there
} bike_hopf;

// The bifurcation at a weave speed found by bike_upright_critical_speeds.
BIKE_API int bike_hopf_at(bike_hopf *out, const bike_model *model, double weave_speed);

// The speed that gives a state of this lean, steer and rates the energy of riding straight and
// upright at `speed`. NOT_STATIONARY where no speed does. Errors of bike_evaluate.
BIKE_API int bike_speed_of_equal_energy(double *out, const bike_model *model,
                                        const bike_state *state, double speed);

#endif
