// SPDX-License-Identifier: Apache-2.0
#include "effects_list.h"

#include <bicycle/error.h>
#include <bicycle/turn.h>
#include <math.h>
#include <string.h>

// Changes of a size that a builder would make, for bicycles that people ride: for others those of
// the similar bicycle. Inertias differ widely between bicycles: theirs is a factor.
typedef struct recipe {
  bike_variation variation;
  bike_front_hold hold;
  double factor, add; // the new value is factor * old + add times its unit
  const char *name;   // NULL: the variation's own
} recipe;

static const recipe recipes[EFFECTS_CHANGES] = {
    {BIKE_VARY_RIDER_FORWARD, BIKE_FRONT_IN_SPACE, 1, 0.05, NULL},
    {BIKE_VARY_TRAIL, BIKE_FRONT_IN_SPACE, 1, 0.01, NULL},
    {BIKE_VARY_TRAIL, BIKE_FRONT_ON_AXIS, 1, 0.01, NULL},
    {BIKE_VARY_HEAD_ANGLE, BIKE_FRONT_IN_SPACE, 1, -4 * M_PI / 180, NULL},
    {BIKE_VARY_HEAD_ANGLE, BIKE_FRONT_ON_AXIS, 1, -4 * M_PI / 180, NULL},
    {BIKE_VARY_STEERING_INERTIA, BIKE_FRONT_IN_SPACE, 1.5, 0, NULL},
    {BIKE_VARY_WHEEL_INERTIA, BIKE_FRONT_IN_SPACE, 1.2, 0, NULL},
    {BIKE_VARY_FRONT_WHEEL_INERTIA, BIKE_FRONT_IN_SPACE, 1.2, 0, NULL},
    {BIKE_VARY_FRONT_WHEEL_INERTIA, BIKE_FRONT_IN_SPACE, 0, 0, "front spin compensated"},
    {BIKE_VARY_STEER_DAMPING, BIKE_FRONT_IN_SPACE, 1, 1, NULL},
};

// What a bicycle's numbers are measured by.
typedef struct scale {
  double length, speed, damping; // m, m/s, N m s/rad: all 1 for what people ride
  double search_end;             // m/s
} scale;

static int scale_of(scale *out, const bike_bicycle *bicycle) {
  // powers of 64 for the mass, as of 4 for the length: those of a similar bicycle of the same
  // density
  const double usual_mass = 90, step = 64;
  bike_model model;
  int code = bike_model_init(&model, bicycle);
  if (code) return code;
  double length = bike_length_unit(&model), speed = sqrt(length);
  double mass = pow(step, round(log(model.total_mass / usual_mass) / log(step)));
  *out = (scale){.length = length,
                 .speed = speed,
                 .damping = mass * length * speed,
                 .search_end = bike_search_end(&model)};
  return BIKE_OK;
}

static double unit_of(bike_variation variation, const scale *unit) {
  if (variation == BIKE_VARY_RIDER_FORWARD || variation == BIKE_VARY_TRAIL) return unit->length;
  return variation == BIKE_VARY_STEER_DAMPING ? unit->damping : 1;
}

static int measure(effects_change *out, const bike_bicycle *bicycle, const double search[2]) {
  bike_model model;
  bike_critical_speeds found;
  int code = bike_model_init(&model, bicycle);
  if (!code) code = bike_upright_critical_speeds(&found, &model, search[0], search[1]);
  if (code) return code;
  out->weave = found.weave_count > 0 ? found.weave[0] : NAN;
  out->capsize = found.capsize_count > 0 ? found.capsize[0] : NAN;
  out->range_count = found.range_count;
  memcpy(out->ranges, found.ranges, sizeof out->ranges);
  return BIKE_OK;
}

static effects_change make_change(const recipe *r, const bike_bicycle *bicycle,
                                  const bike_effects *now, const double search[2],
                                  const scale *unit) {
  effects_change c = {.name = r->name ? r->name : bike_variation_name(r->variation),
                      .unit = bike_variation_unit(r->variation),
                      .held = bike_variation_held(r->variation, r->hold),
                      .from = NAN,
                      .to = NAN,
                      .weave = NAN,
                      .capsize = NAN,
                      .weave_slope = NAN,
                      .capsize_slope = NAN};
  bike_bicycle changed;
  c.error = bike_variation_value(&c.from, bicycle, r->variation);
  if (c.error) return c;
  c.to = r->factor * c.from + r->add * unit_of(r->variation, unit);
  c.error = bike_vary(&changed, bicycle, r->variation, c.to, r->hold);
  if (!c.error)
    c.error = bike_variation_slope(&c.weave_slope, &c.capsize_slope, bicycle, r->variation, r->hold,
                                   now->weave, now->capsize);
  if (!c.error) c.error = measure(&c, &changed, search);
  return c;
}

static int find_lean(effects_list *out, const double search[2], double speed, const scale *unit) {
  const double some_speed = 5 * unit->speed; // where no stable range is, one at which people ride
  bike_model model;
  bike_critical_speeds found;
  int code = bike_model_init(&model, &out->file.bicycle);
  if (!code) code = bike_upright_critical_speeds(&found, &model, search[0], search[1]);
  if (code) return code;
  out->speed = speed;
  if (isnan(speed))
    out->speed =
        found.range_count > 0 ? 0.5 * (found.ranges[0][0] + found.ranges[0][1]) : some_speed;
  out->lean_per_offset = NAN;
  code = bike_lean_per_offset(&out->lean_per_offset, &model, out->speed);
  return code == BIKE_ERROR_NO_RIDER ? BIKE_OK : code;
}

static int find_all(effects_list *out, const double search[2], double speed, const scale *unit) {
  const bike_meijaard *literature = out->file.has_meijaard ? &out->file.meijaard : NULL;
  int code = bike_effects_find(&out->effects, &out->file.bicycle, literature, search[0], search[1]);
  if (!code) code = find_lean(out, search, speed, unit);
  if (code) return code;
  for (out->count = 0; out->count < EFFECTS_CHANGES; out->count++)
    out->changes[out->count] =
        make_change(&recipes[out->count], &out->file.bicycle, &out->effects, search, unit);
  return BIKE_OK;
}

int effects_list_make(effects_list *out, const double search[2], double speed) {
  scale unit;
  int code = scale_of(&unit, &out->file.bicycle);
  if (code) return code;
  const double usual[2] = {0, unit.search_end};
  return find_all(out, search ? search : usual, speed, &unit);
}
