// SPDX-License-Identifier: Apache-2.0
#include "wild.h"
#include "bicycles.h"
#include <float.h>
#include <math.h>

static bool chance(random_source *source, double share) {
  return random_between(source, 0, 1) < share;
}

static int one_of(random_source *source, int count) {
  return (int)(random_bits(source) % (uint64_t)count);
}

// 10^low .. 10^high; pow() of the ends of the range may be 0 or infinite.
static double log_uniform(random_source *source, double low, double high) {
  return pow(10, random_between(source, low, high));
}

double wild_number(random_source *source) {
  static const double ends[] = {0, DBL_TRUE_MIN, DBL_MIN, DBL_EPSILON, 1, 1e154, DBL_MAX};
  double sign = chance(source, 0.5) ? -1 : 1;
  switch (one_of(source, 4)) {
  case 0:
    return sign * ends[one_of(source, sizeof ends / sizeof *ends)];
  case 1:
    return sign * log_uniform(source, -6, 6);
  default:
    return sign * log_uniform(source, -323, 308);
  }
}

// A few numbers of the description, wild or zero, or wild multiples of what they were.
static void spoil(bike_bicycle *b, random_source *source) {
  bike_geometry *g = &b->geometry;
  for (int n = 1 + one_of(source, 3); n > 0; n--) {
    bike_part *p = &b->parts[one_of(source, b->part_count)];
    double *const places[] = {&g->L_r,         &g->L_f,         &g->L_s,           &g->R_r,
                              &g->R_f,         &b->gravity,     &b->steer_damping, &p->mass,
                              &p->position[0], &p->position[1], &p->position[2]};
    const int own = sizeof places / sizeof *places;
    int which = one_of(source, own + 6);
    double *place = which < own ? places[which] : &p->inertia[which - own];
    double wild = wild_number(source);
    *place = chance(source, 0.5) ? wild : *place * fabs(wild);
  }
}

static void put_hubs(bike_bicycle *b) {
  bike_upright upright;
  if (bike_upright_position(&upright, &b->geometry)) return;
  for (int i = 0; i < b->part_count; i++) {
    bike_part *p = &b->parts[i];
    const double *hub = p->assembly == BIKE_REAR_WHEEL ? upright.rear_hub : upright.front_hub;
    bool wheel = p->assembly == BIKE_REAR_WHEEL || p->assembly == BIKE_FRONT_WHEEL;
    for (int k = 0; k < 3 && wheel; k++) p->position[k] = hub[k];
  }
}

// The same shape: lengths, masses and gravity each times a number of their own.
static void scale(bike_bicycle *b, random_source *source) {
  double reach = random_between(source, 0, 1) < 0.5 ? 25 : 100;
  double length = log_uniform(source, -reach, reach), mass = log_uniform(source, -reach, reach);
  bike_geometry *g = &b->geometry;
  double *const lengths[] = {&g->L_r, &g->L_f, &g->L_s, &g->R_r, &g->R_f};
  for (int i = 0; i < 5; i++) *lengths[i] *= length;
  b->gravity *= log_uniform(source, -reach, reach);
  b->steer_damping *= log_uniform(source, -reach, reach);
  for (int i = 0; i < b->part_count; i++) {
    bike_part *p = &b->parts[i];
    p->mass *= mass;
    for (int k = 0; k < 3; k++) p->position[k] *= length;
    for (int k = 0; k < 6; k++) p->inertia[k] *= mass * length * length;
  }
  put_hubs(b);
}

// A wheelbase, a trail, a tilt or a radius near where the geometry ends.
static void strain(bike_bicycle *b, random_source *source) {
  double small = log_uniform(source, -18, -1), base = 1, trail = 0.1, tilt = 0.3;
  double R_r = 0.3, R_f = 0.3;
  switch (one_of(source, 5)) {
  case 0:
    base = small;
    break;
  case 1:
    trail = chance(source, 0.5) ? small - base : 1 / small;
    break;
  case 2:
    tilt = (chance(source, 0.5) ? 1 : -1) * (1.5707963267948966 - small);
    break;
  case 3:
    R_f = small;
    break;
  default:
    R_r = 1 / small;
  }
  b->geometry = bike_geometry_from_wheelbase(base, trail, tilt, R_r, R_f);
  put_hubs(b);
}

bike_bicycle wild_bicycle(random_source *source) {
  bike_bicycle b = random_bicycle(source, chance(source, 0.5));
  switch (one_of(source, 5)) {
  case 0:
    break;
  case 1:
    scale(&b, source);
    break;
  case 2:
    strain(&b, source);
    break;
  case 3:
    spoil(&b, source);
    put_hubs(&b);
    break;
  default:
    spoil(&b, source);
  }
  return b;
}

bike_state wild_state(random_source *source) {
  const random_range range = {1.6, 3.2, 5, -10, 10};
  bike_state s = random_state(source, &range);
  double *const places[] = {&s.lean, &s.steer, &s.lean_rate, &s.steer_rate, &s.speed};
  int spoiled = one_of(source, 4);
  if (chance(source, 0.5)) s.lean *= 0.2, s.steer *= 0.2;
  for (; spoiled > 0; spoiled--) *places[one_of(source, 5)] = wild_number(source);
  return s;
}

bike_input wild_input(random_source *source, bool rider) {
  bike_input in = {0};
  double *const places[] = {&in.steer_torque, &in.roll_torque, &in.rider_offset, &in.rider_velocity,
                            &in.rider_acceleration};
  int kind = one_of(source, 3), count = rider ? 5 : 2;
  for (int i = 0; i < count && kind > 0; i++)
    *places[i] = kind == 1 ? random_between(source, -5, 5) : wild_number(source);
  return in;
}

static int code_at(const bike_model *model, const bike_state *state, double share) {
  bike_state s = *state;
  bike_snapshot now;
  s.lean *= share;
  s.steer *= share;
  return bike_evaluate(&now, model, &s, NULL);
}

bool wild_edge(bike_state *state, const bike_model *model) {
  double inside = 0, outside = 1;
  if (code_at(model, state, inside) || !code_at(model, state, outside)) return false;
  for (int cut = 0; cut < 60; cut++) {
    double middle = 0.5 * (inside + outside);
    *(code_at(model, state, middle) ? &outside : &inside) = middle;
  }
  state->lean *= inside;
  state->steer *= inside;
  return true;
}
