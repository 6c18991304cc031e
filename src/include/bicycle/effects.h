// SPDX-License-Identifier: Apache-2.0
// How the weave and capsize speeds of upright riding depend on every parameter: exact derivatives,
// and what the uncertainty of the parameters makes of them.
//
// A critical speed v is a root of F(v, p) = 0, F = a0 (capsize) or Hurwitz' a1 a2 a3 - a1^2 a4 - a0
// a3^2 (weave) of the characteristic polynomial, so that dv/dp = -F_p/F_v. Both derivatives are
// taken by complex step through the published upright equations of Meijaard et al. (2007), appendix
// A, with which the linearised kernel agrees to rounding (the tests compare both).
#ifndef BICYCLE_EFFECTS_H
#define BICYCLE_EFFECTS_H

#include <bicycle/file.h>
#include <bicycle/model.h>
#include <bicycle/variant.h>

enum {
  BIKE_FRAME_PARAMETERS = 7, // wheelbase, trail, tilt, radii, gravity, damping
  BIKE_PART_PARAMETERS = 7,  // mass, two coordinates, four of the tensor
  BIKE_MAX_PARAMETERS = BIKE_FRAME_PARAMETERS + BIKE_PART_PARAMETERS * BIKE_MAX_PARTS,
  BIKE_PARAMETER_NAME_SIZE = BIKE_NAME_SIZE + 16
};

// One parameter; the others of the list are held. Derivatives are per unit of it, NaN where there
// is no such speed.
typedef struct bike_parameter {
  char name[BIKE_PARAMETER_NAME_SIZE]; // "tilt", "rider: forward"; literature: "lam", "xB"
  const char *unit;                    //
  double value;                        //
  double sigma;                        // standard uncertainty, 0 where none is known
  double weave, capsize;               // m/s per unit: derivative of the speed
} bike_parameter;

typedef struct bike_effects {
  double weave, capsize;             // m/s  the first weave and capsize speeds; NaN where none
  double weave_sigma, capsize_sigma; // m/s  first order, parameters independent
  int count;
  bike_parameter parameters[BIKE_MAX_PARAMETERS];
} bike_effects;

// Of every parameter of a bicycle: wheelbase, trail, tilt and so on, then those of its parts in
// (forward, up). With `literature`, the parameters are Meijaard's symbols in their order and signs
// (z down), with their uncertainties; `bicycle` is then the same bicycle and gives the damping.
// The first critical speeds in low <= speed <= high. Errors: those of
// bike_upright_critical_speeds and bike_model_init.
BIKE_API int bike_effects_find(bike_effects *out, const bike_bicycle *bicycle,
                               const bike_meijaard *literature, double low, double high);

// Derivative of a critical speed with respect to a variation, at the bicycle's present value; NaN
// for a speed of NaN. Errors: those of bike_variation_value.
BIKE_API int bike_variation_slope(double *weave_slope, double *capsize_slope,
                                  const bike_bicycle *bicycle, bike_variation variation,
                                  bike_front_hold hold, double weave, double capsize);

// d(lean)/d(rider offset) of steady riding near upright, rad/m, at a speed: infinite at the capsize
// speed. BIKE_ERROR_NO_RIDER without a rider; NOT_FINITE for a speed beyond BIKE_LARGEST; errors of
// bike_linearize_upright.
BIKE_API int bike_lean_per_offset(double *out, const bike_model *model, double speed);

#endif
