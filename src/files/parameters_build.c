// SPDX-License-Identifier: Apache-2.0
#include "parameters_build.h"

#include "angle.h"
#include "message.h"
#include "plausible.h"

#include <bicycle/error.h>
#include <math.h>
#include <string.h>

// The library's messages about files begin with "path:line: "; here neither means anything.
static void cut_place(bike_file_error *error) {
  if (!error || error->text[0] != ':') return;
  const char *rest = error->text + 1 + strspn(error->text + 1, "0123456789");
  if (strncmp(rest, ": ", 2) == 0) rest += 2;
  memmove(error->text, rest, strlen(rest) + 1);
}

int parameters_from_symbols(bike_bicycle *out, bike_symbols *symbols, bike_file_error *error) {
  bike_file file = {0};
  // A file may repeat the second diameter of a wheel: it follows the first.
  symbols->line[MEIJAARD_IRZZ] = symbols->line[MEIJAARD_IFZZ] = 0;
  const int code = bike_symbols_to_file(&file, symbols, "", error);
  if (code)
    cut_place(error);
  else
    *out = file.bicycle;
  return code;
}

bool parameters_is_wheel(const bike_component *c) {
  return c->part.assembly == BIKE_REAR_WHEEL || c->part.assembly == BIKE_FRONT_WHEEL;
}

static int check_measures(const bike_description *d, bike_file_error *error) {
  const bike_measures *m = &d->measures;
  if (d->by_lengths) return BIKE_OK;
  if (!(m->wheelbase > 0))
    return bike_message(error, BIKE_ERROR_PARAMETER, "wheelbase must be positive");
  char what[BIKE_ANGLE_TEXT];
  if (bike_angle_check(what, &bike_head_angle_range, m->head_angle)) return BIKE_OK;
  return bike_message(error, BIKE_ERROR_PARAMETER, "head_angle %s", what);
}

static void place_wheel(bike_component *c, const bike_upright *upright) {
  const bool rear = c->part.assembly == BIKE_REAR_WHEEL;
  memcpy(c->part.position, rear ? upright->rear_hub : upright->front_hub, sizeof c->part.position);
  if (c->kind == BIKE_INERTIA_FULL) c->part.inertia[2] = c->part.inertia[0];
}

static int check(const bike_bicycle *bicycle, bike_file_error *error) {
  int part;
  const char *rule = NULL;
  bike_doubt doubt;
  int code = bike_check(bicycle, &part, &rule);
  if (!code && bike_has_doubt(&doubt, bicycle)) {
    code = BIKE_ERROR_PARAMETER;
    part = doubt.part;
    rule = doubt.text;
  }
  if (!code) return BIKE_OK;
  if (!rule) rule = bike_error_string(code);
  if (part < 0) return bike_message(error, code, "%s", rule);
  return bike_message(error, code, "part '%s': %s", bicycle->parts[part].name, rule);
}

int parameters_from_description(bike_bicycle *out, bike_description *d, bike_file_error *error) {
  bike_upright upright;
  int code = check_measures(d, error);
  if (code) return code;
  if (!d->by_lengths) d->geometry = bike_geometry_of_measures(&d->measures);
  code = bike_upright_position(&upright, &d->geometry);
  if (code) return bike_message(error, code, "%s", bike_error_string(code));
  *out = bike_default_bicycle();
  out->geometry = d->geometry;
  out->gravity = d->gravity;
  out->steer_damping = d->steer_damping;
  out->part_count = d->count;
  for (int i = 0; i < d->count; i++) {
    bike_component *c = &d->parts[i];
    if (c->kind != BIKE_INERTIA_NONE && c->kind != BIKE_INERTIA_FULL && !(c->theta >= 0))
      return bike_message(error, BIKE_ERROR_PARAMETER, "part '%s': inertia must not be negative",
                          c->part.name);
    bike_component_tensor(c, upright.tilt);
    if (parameters_is_wheel(c)) place_wheel(c, &upright);
    out->parts[i] = c->part;
  }
  return check(out, error);
}
