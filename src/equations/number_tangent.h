// SPDX-License-Identifier: Apache-2.0
// The kernel over tangents: a value and SLOPES exact derivatives of it (1 to 8, set before; 1
// else), each for LANES states at a time. The kernel comes lowered by tangent/lower.py, since C has
// no operators on structs.
//
// One value with many slopes costs far less than many passes with one: the values are found once,
// and a slope that is a constant zero (the parameters', the geometry's with respect to the speeds)
// is left out by the compiler where it may take 0 x for 0: -ffinite-math-only -fno-signed-zeros.
// So it must see that it is zero: give each variable its slope where solve_instant is called.
#ifndef BICYCLE_NUMBER_TANGENT_H
#define BICYCLE_NUMBER_TANGENT_H

#include "equations/lane_math.h"

#ifndef SLOPES
#define SLOPES 1
#endif

typedef struct real {
  lanes value;
  lanes slope[SLOPES];
} real;

// EACH_SLOPE(statement with j) repeats it for j = 0 .. SLOPES - 1. Not a loop: an array whose
// indices are not constant from the outset stays in memory.
#define SLOPE_IS(index, ...)                                                                       \
  {                                                                                                \
    enum { j = index };                                                                            \
    __VA_ARGS__;                                                                                   \
  }
#define EACH_OF_1(...) SLOPE_IS(0, __VA_ARGS__)
#define EACH_OF_2(...) EACH_OF_1(__VA_ARGS__) SLOPE_IS(1, __VA_ARGS__)
#define EACH_OF_3(...) EACH_OF_2(__VA_ARGS__) SLOPE_IS(2, __VA_ARGS__)
#define EACH_OF_4(...) EACH_OF_3(__VA_ARGS__) SLOPE_IS(3, __VA_ARGS__)
#define EACH_OF_5(...) EACH_OF_4(__VA_ARGS__) SLOPE_IS(4, __VA_ARGS__)
#define EACH_OF_6(...) EACH_OF_5(__VA_ARGS__) SLOPE_IS(5, __VA_ARGS__)
#define EACH_OF_7(...) EACH_OF_6(__VA_ARGS__) SLOPE_IS(6, __VA_ARGS__)
#define EACH_OF_8(...) EACH_OF_7(__VA_ARGS__) SLOPE_IS(7, __VA_ARGS__)
#define EACH_OF_COUNT(count, ...) EACH_OF_##count(__VA_ARGS__)
#define EACH_OF(count, ...) EACH_OF_COUNT(count, __VA_ARGS__)
#define EACH_SLOPE(...) EACH_OF(SLOPES, __VA_ARGS__)

// A number that depends on none of the variables.
LANE_INLINE real tangent_constant(lanes x) {
  return (real){.value = x};
}

LANE_INLINE real real_of(double x) {
  return tangent_constant(lanes_of(x));
}

// The variable that slope `index` is the derivative with respect to.
LANE_INLINE real tangent_variable(lanes x, int index) {
  real r = tangent_constant(x);
  r.slope[index] = lanes_of(1);
  return r;
}

LANE_INLINE real tangent_add(real a, real b) {
  real r = {.value = a.value + b.value};
  EACH_SLOPE(r.slope[j] = a.slope[j] + b.slope[j])
  return r;
}

LANE_INLINE real tangent_sub(real a, real b) {
  real r = {.value = a.value - b.value};
  EACH_SLOPE(r.slope[j] = a.slope[j] - b.slope[j])
  return r;
}

LANE_INLINE real tangent_neg(real a) {
  real r = {.value = -a.value};
  EACH_SLOPE(r.slope[j] = -a.slope[j])
  return r;
}

LANE_INLINE real tangent_mul(real a, real b) {
  real r = {.value = a.value * b.value};
  EACH_SLOPE(r.slope[j] = a.slope[j] * b.value + a.value * b.slope[j])
  return r;
}

LANE_INLINE real tangent_div(real a, real b) {
  lanes over_b = 1.0 / b.value;
  real r = {.value = a.value * over_b};
  EACH_SLOPE(r.slope[j] = (a.slope[j] - r.value * b.slope[j]) * over_b)
  return r;
}

// k - a, k a and k/a for a plain number k.
LANE_INLINE real tangent_from(double k, real a) {
  real r = {.value = k - a.value};
  EACH_SLOPE(r.slope[j] = -a.slope[j])
  return r;
}

LANE_INLINE real tangent_scale(double k, real a) {
  real r = {.value = k * a.value};
  EACH_SLOPE(r.slope[j] = k * a.slope[j])
  return r;
}

LANE_INLINE real tangent_over(double k, real a) {
  lanes over_a = 1.0 / a.value;
  real r = {.value = k * over_a};
  lanes gain = -r.value * over_a;
  EACH_SLOPE(r.slope[j] = gain * a.slope[j])
  return r;
}

LANE_INLINE real real_sqrt(real a) {
  real r = {.value = lanes_sqrt(a.value)};
  lanes gain = 0.5 / r.value;
  EACH_SLOPE(r.slope[j] = gain * a.slope[j])
  return r;
}

LANE_INLINE void real_sincos(real a, real *s, real *c) {
  lanes sine, cosine;
  lanes_sincos(a.value, &sine, &cosine);
  *s = tangent_constant(sine);
  *c = tangent_constant(cosine);
  EACH_SLOPE(s->slope[j] = cosine * a.slope[j]; c->slope[j] = -sine * a.slope[j])
}

LANE_INLINE real real_anew(real a) {
  return a;
}

#include "kernel_tangent.h"

LANE_INLINE real without_slopes(real a) {
  return tangent_constant(a.value);
}

// Newton's steps on the values alone, then the slopes of one more step from the root (locate_known
// says why). Slopes carried through the steps themselves would lag one step behind the values, and
// cost three times as much.
LANE_INLINE void solve_rear_angle(posture *g, const kernel_geometry *L, start from) {
  posture root = {.s_phi = without_slopes(g->s_phi),
                  .c_phi = without_slopes(g->c_phi),
                  .s_kap = without_slopes(g->s_kap),
                  .c_kap = without_slopes(g->c_kap)};
  kernel_geometry lengths = {without_slopes(L->L_r), without_slopes(L->L_f), without_slopes(L->L_s),
                             without_slopes(L->R_r), without_slopes(L->R_f)};
  start plain = {without_slopes(from.s), without_slopes(from.c), without_slopes(from.r)};
  newton_rear_angle(NEWTON_STEPS, &root, &lengths, plain);
  newton_rear_angle(1, g, L, (start){root.s_br, root.c_br, real_of(1)});
  g->s_br.value = root.s_br.value;
  g->c_br.value = root.c_br.value;
  g->over_a.value = root.over_a.value;
}

#endif
