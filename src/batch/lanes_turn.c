// SPDX-License-Identifier: Apache-2.0
// Stationary motion at given speeds and leans, in lanes: Newton's method in steer and rider offset.
#include "batch/lanes_block.h"
#include "batch/lanes_instance.h"

// Differences for the slopes, rad and m: right to 1e-6 or so of themselves, which costs the method
// nothing but a digit a step; the forces are polynomials of low degree in the offset.
static const double STEER_STEP = 1e-7, OFFSET_STEP = 1e-4;
// After a step as short as this, rad and m, what is left is its square and the slopes' error times
// it: rounding.
static const double LAST_STEP = 1e-8;
// From a neighbour of the solution four are enough; who needs more has lost his way.
enum { MOST_STEPS = 8 };

typedef struct forces {
  real steer, lean;
} forces;

// Generalised forces at rest in lean and steer, which stationary motion wants to vanish.
__attribute__((noinline, flatten)) static void forces_at(forces *out, lanes_mask *found,
                                                         const lanes_models *block, real lean,
                                                         real steer, real offset, real speed) {
  const kernel_model *m = &block->model;
  real nought = lean - lean;
  load in = {nought, nought, offset, nought, nought};
  instant now;
  solve_instant(&now, m, guessed(m, steer, lean), steer, lean, (form){nought, nought, speed}, &in);
  *out = (forces){now.k.f[0], now.k.f[1]};
  *found = lanes_found(root_checks_of(&now.at), block->reach) & (now.at.D > nought);
}

unsigned INSTANCE(lanes_turn)(double *steer, double *offset, const lanes_models *block,
                              const double *speed, const double *lean) {
  real phi = loaded(steer), w = loaded(offset), v = loaded(speed), kappa = loaded(lean);
  real nought = phi - phi;
  lanes_mask found, aside, done = {0};
  for (int step = 0; step < MOST_STEPS && lanes_bits(~done); step++) {
    forces f, by_steer, by_offset;
    forces_at(&f, &found, block, kappa, phi, w, v);
    forces_at(&by_steer, &aside, block, kappa, phi + STEER_STEP, w, v);
    forces_at(&by_offset, &aside, block, kappa, phi, w + OFFSET_STEP, v);
    real a = (by_steer.steer - f.steer) / STEER_STEP, b = (by_offset.steer - f.steer) / OFFSET_STEP;
    real c = (by_steer.lean - f.lean) / STEER_STEP, d = (by_offset.lean - f.lean) / OFFSET_STEP;
    real over = 1.0 / (a * d - b * c);
    real dphi = (b * f.lean - d * f.steer) * over, dw = (c * f.steer - a * f.lean) * over;
    // who is done stays, whatever his neighbours still need
    phi = lanes_either(done, phi, phi + dphi);
    w = lanes_either(done, w, w + dw);
    done |= found & (lanes_abs(dphi) <= LAST_STEP + nought) & (lanes_abs(dw) <= LAST_STEP + nought);
  }
  memcpy(steer, &phi, sizeof phi);
  memcpy(offset, &w, sizeof w);
  return lanes_bits(done);
}
