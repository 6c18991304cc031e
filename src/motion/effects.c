// SPDX-License-Identifier: Apache-2.0
#include <bicycle/effects.h>

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "motion/effects_parameters.h"
#include "motion/effects_upright.h"

static const double STEP = 1e-100; // leaves the real parts untouched

// Both derivatives of the functions at one speed along a perturbed bicycle.
static void slope(double *out, const vary_bicycle *perturbed, const vary_bicycle *b, double speed,
                  bool weave) {
  *out = NAN;
  if (isnan(speed)) return;
  critical_functions along_p = critical_functions_at(perturbed, speed);
  critical_functions along_v = critical_functions_at(b, speed + I * STEP);
  *out = weave ? -cimag(along_p.weave) / cimag(along_v.weave)
               : -cimag(along_p.capsize) / cimag(along_v.capsize);
}

static int find_speeds(bike_effects *out, const bike_bicycle *bicycle, double low, double high) {
  bike_model model;
  bike_critical_speeds found;
  int code = bike_model_init(&model, bicycle);
  if (!code) code = bike_upright_critical_speeds(&found, &model, low, high);
  if (code) return code;
  out->weave = found.weave_count > 0 ? found.weave[0] : NAN;
  out->capsize = found.capsize_count > 0 ? found.capsize[0] : NAN;
  return BIKE_OK;
}

// First order: variances of independent parameters add.
static void combine(bike_effects *out) {
  double weave = 0, capsize = 0;
  for (int i = 0; i < out->count; i++) {
    const bike_parameter *p = &out->parameters[i];
    weave = hypot(weave, p->sigma > 0 ? p->weave * p->sigma : 0);
    capsize = hypot(capsize, p->sigma > 0 ? p->capsize * p->sigma : 0);
  }
  out->weave_sigma = isnan(out->weave) ? NAN : weave;
  out->capsize_sigma = isnan(out->capsize) ? NAN : capsize;
}

int bike_effects_find(bike_effects *out, const bike_bicycle *bicycle,
                      const bike_meijaard *literature, double low, double high) {
  if (!out || !bicycle) return BIKE_ERROR_ARGUMENT;
  memset(out, 0, sizeof *out);
  int code = find_speeds(out, bicycle, low, high);
  if (code) return code;
  bike_bicycle described = *bicycle;
  if (literature) {
    code = bike_from_meijaard(&described, literature->value);
    described.steer_damping = bicycle->steer_damping;
  }
  vary_bicycle b;
  if (!code) code = vary_read(&b, &described);
  if (code) return code;
  out->count = parameters_list(out->parameters, &described, literature);
  for (int i = 0; i < out->count; i++) {
    vary_bicycle perturbed = b;
    parameters_add(&perturbed, i, literature != NULL, I * STEP);
    slope(&out->parameters[i].weave, &perturbed, &b, out->weave, true);
    slope(&out->parameters[i].capsize, &perturbed, &b, out->capsize, false);
  }
  combine(out);
  return BIKE_OK;
}

int bike_variation_slope(double *weave_slope, double *capsize_slope, const bike_bicycle *bicycle,
                         bike_variation variation, bike_front_hold hold, double weave,
                         double capsize) {
  if (!weave_slope || !capsize_slope || !bicycle) return BIKE_ERROR_ARGUMENT;
  vary_bicycle b;
  number value;
  int code = vary_read(&b, bicycle);
  if (!code) code = vary_value(&value, &b, variation);
  vary_bicycle perturbed = b;
  if (!code) code = vary_apply(&perturbed, variation, value + I * STEP, hold);
  if (code) return code;
  slope(weave_slope, &perturbed, &b, weave, true);
  slope(capsize_slope, &perturbed, &b, capsize, false);
  return BIKE_OK;
}

int bike_lean_per_offset(double *out, const bike_model *model, double speed) {
  if (!out || !model) return BIKE_ERROR_ARGUMENT;
  if (!(fabs(speed) <= BIKE_LARGEST)) return BIKE_ERROR_NOT_FINITE;
  if (!(model->rider_mass > 0)) return BIKE_ERROR_NO_RIDER;
  bike_upright_matrices m;
  int code = bike_linearize_upright(&m, model);
  if (code) return code;
  // (g K0 + v^2 K2) (lean, steer) = (m_rider g w, 0): the offset weighs on the lean alone
  double K[4], g = model->gravity;
  for (int i = 0; i < 4; i++) K[i] = g * m.K0[i] + speed * speed * m.K2[i];
  double slope = model->rider_mass * g * K[3] / (K[0] * K[3] - K[1] * K[2]);
  if (isnan(slope)) return BIKE_ERROR_NOT_FINITE;
  *out = slope;
  return BIKE_OK;
}
