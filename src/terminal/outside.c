// SPDX-License-Identifier: Apache-2.0
#include "terminal/outside.h"

#include "terminal/command.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

//---------------------------------- options -------------------------------------------------------

enum { KEY_FRICTION = TERM_KEY_FIRST, KEY_REACH };

static error_t parse(int key, char *text, struct argp_state *state) {
  term_limits *limits = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    *limits = (term_limits){.friction = 1};
    return 0;
  case KEY_FRICTION:
    limits->friction = term_positive_of("--friction", text);
    return 0;
  case KEY_REACH:
    limits->reach = term_positive_of("--reach", text);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"friction", KEY_FRICTION, "MU", 0,
     "Coefficient of friction of the ground; what asks more is marked as outside physics (1)", 6},
    {"reach", KEY_REACH, "W", 0,
     "How far the rider can move to the side, m; farther is marked likewise (a fifth of the height "
     "of his centre of mass)",
     6},
    {0},
};

const struct argp term_limits_argp = {.options = options, .parser = parse};

void term_set_reach(term_limits *limits, const bike_bicycle *bicycle) {
  if (limits->reach > 0) return;
  for (int i = 0; i < bicycle->part_count; i++)
    if (bicycle->parts[i].rider) limits->reach = fabs(bicycle->parts[i].position[2]) / 5;
}

//---------------------------------- what is outside -----------------------------------------------

static void add(term_outside *out, term_outside_item item) {
  if (out->count < TERM_MOST_OUTSIDE) out->items[out->count++] = item;
}

void term_outside_wheel(term_outside *out, const char *wheel, double normal, double friction,
                        const term_limits *limits) {
  if (!(normal > 0))
    add(out, (term_outside_item){.kind = TERM_PULLED, .wheel = wheel, .value = fabs(normal)});
  else if (!(friction <= limits->friction))
    add(out,
        (term_outside_item){
            .kind = TERM_FRICTION, .wheel = wheel, .value = friction, .limit = limits->friction});
}

void term_outside_rider(term_outside *out, double offset, const term_limits *limits) {
  if (limits->reach > 0 && !(fabs(offset) <= limits->reach))
    add(out,
        (term_outside_item){.kind = TERM_RIDER, .value = fabs(offset), .limit = limits->reach});
}

void term_outside_ride(term_outside *out, const char *wheel, bool disc,
                       const bike_wheel_ground *ground, const term_limits *limits) {
  if (ground->lifted.count > 0)
    add(out, (term_outside_item){.kind = TERM_PULLED,
                                 .wheel = wheel,
                                 .disc = disc,
                                 .value = fmax(0, -ground->normal),
                                 .time = ground->normal_time,
                                 .spells = &ground->lifted});
  if (ground->no_grip.count > 0)
    add(out, (term_outside_item){.kind = TERM_FRICTION,
                                 .wheel = wheel,
                                 .disc = disc,
                                 .value = ground->friction,
                                 .limit = limits->friction,
                                 .time = ground->friction_time,
                                 .spells = &ground->no_grip});
}

//---------------------------------- words ---------------------------------------------------------

void term_friction_text(char out[32], double friction) {
  snprintf(out, 32, isinf(friction) ? "without bound" : "%.4g", friction);
}

// As many digits as tell a value from the limit that it exceeds.
static void put_value(char out[32], double value, double limit) {
  char other[32];
  term_friction_text(out, value);
  snprintf(other, 32, "%.4g", limit);
  if (strcmp(out, other) == 0) snprintf(out, 32, "%.17g", value);
}

static void put_spells(char out[96], const term_outside_item *item) {
  const bike_spells *s = item->spells;
  out[0] = '\0';
  if (s) snprintf(out, 96, ": first at %.6g s, for %.4g s in all", s->first, s->duration);
}

void term_outside_text(char out[TERM_OUTSIDE_SIZE], const term_outside_item *item) {
  char value[32], spells[96], when[48] = "";
  const char *the = item->disc ? "" : "the ", *wheel = item->disc ? "" : " wheel";
  put_value(value, item->value, item->limit);
  put_spells(spells, item);
  if (item->spells) snprintf(when, sizeof when, " at %.6g s", item->time);
  switch (item->kind) {
  case TERM_PULLED:
    snprintf(out, TERM_OUTSIDE_SIZE, "%s%s%s is pulled with %s%s N%s%s", the, item->wheel, wheel,
             item->spells ? "up to " : "", value, when, spells);
    return;
  case TERM_FRICTION:
    snprintf(out, TERM_OUTSIDE_SIZE, "%s%s%s asks friction %s%s, more than %g%s", the, item->wheel,
             wheel, value, when, item->limit, spells);
    return;
  case TERM_RIDER:
    snprintf(out, TERM_OUTSIDE_SIZE, "the rider sits %s m to the side, more than %.4g m", value,
             item->limit);
    return;
  }
}

void term_outside_brief(char out[TERM_OUTSIDE_SIZE], const term_outside *outside) {
  size_t used = 0;
  out[0] = '\0';
  for (int i = 0; i < outside->count && used < TERM_OUTSIDE_SIZE; i++) {
    const term_outside_item *item = &outside->items[i];
    const char *wheel = item->wheel ? item->wheel : "";
    const char *format = item->kind == TERM_PULLED     ? "%s%s pulled %.4g N"
                         : item->kind == TERM_FRICTION ? "%s%s friction %.3g"
                                                       : "%s%srider %.3g cm";
    double value = item->kind == TERM_RIDER ? 100 * item->value : item->value;
    used += (size_t)snprintf(out + used, TERM_OUTSIDE_SIZE - used, format, i > 0 ? ", " : "", wheel,
                             value);
  }
}

json_t *term_outside_json(const term_outside *outside) {
  static const char *const kinds[] = {
      [TERM_PULLED] = "pulled", [TERM_FRICTION] = "friction", [TERM_RIDER] = "rider"};
  json_t *list = json_array();
  for (int i = 0; i < outside->count; i++) {
    const term_outside_item *item = &outside->items[i];
    json_t *object = json_object();
    if (item->wheel)
      json_object_set_new(object, item->disc ? "disc" : "wheel", term_json_text(item->wheel));
    json_object_set_new(object, "kind", json_string(kinds[item->kind]));
    json_object_set_new(object, "value", term_json_number(item->value));
    json_object_set_new(object, "limit", term_json_number(item->limit));
    if (item->spells) {
      json_object_set_new(object, "time", term_json_number(item->time));
      json_object_set_new(object, "first", term_json_number(item->spells->first));
      json_object_set_new(object, "duration", term_json_number(item->spells->duration));
    }
    json_array_append_new(list, object);
  }
  return list;
}
