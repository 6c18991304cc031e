// SPDX-License-Identifier: Apache-2.0
// The limit cycle with a given energy, between two of a branch.
#include <bicycle/cycle.h>
#include <bicycle/error.h>
#include <math.h>

// An end of the interval: lean squared, of which the speed is nearly a linear function, and by how
// much the speed there is too high.
typedef struct bound {
  double square, excess;
} bound;

// Where the chord is zero, kept off the ends so that each step shortens the interval.
static double next_square(const bound *a, const bound *b) {
  const double margin = 1e-3;
  double part = a->excess / (a->excess - b->excess);
  return a->square + fmin(fmax(part, margin), 1 - margin) * (b->square - a->square);
}

int bike_cycle_of_speed(bike_cycle *out, const bike_model *model, double speed, double weave_speed,
                        const bike_cycle *smaller, const bike_cycle *larger) {
  enum { STEPS = 60 };
  // shooting leaves 1e-9 of the amplitude, and the speed of the cycle is as good
  const double enough = 1e-9; // m/s
  if (!out || !model || !larger || !(weave_speed > 0)) return BIKE_ERROR_ARGUMENT;
  bound a = {smaller ? smaller->lean * smaller->lean : 0,
             (smaller ? smaller->speed : weave_speed) - speed};
  bound b = {larger->lean * larger->lean, larger->speed - speed};
  if (!(a.square < b.square) || !(a.excess * b.excess <= 0)) return BIKE_ERROR_ARGUMENT;
  bike_cycle cycle = *larger;
  if (b.excess == 0) {
    *out = cycle;
    return BIKE_OK;
  }
  for (int i = 0; i < STEPS; i++) {
    double square = next_square(&a, &b);
    int code = bike_cycle_find(&cycle, model, sqrt(square), weave_speed, &cycle);
    if (code) return code;
    bound now = {square, cycle.speed - speed};
    if (fabs(now.excess) <= enough) {
      *out = cycle;
      return BIKE_OK;
    }
    // Illinois: an end that stays counts for half, or it would stay for ever
    if ((now.excess > 0) == (b.excess > 0)) {
      b = now;
      a.excess *= 0.5;
    } else {
      a = now;
      b.excess *= 0.5;
    }
  }
  return BIKE_ERROR_NO_CONVERGENCE;
}
