// SPDX-License-Identifier: Apache-2.0
// `parameterization: components`: the frame as builders measure it, and a list of parts.
#include "components.h"
#include "angle.h"
#include "forms.h"
#include "plausible.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// A wheel's place may be left out; given, it may be off its hub by the rounding of a length written
// in whole micrometres, and is put there.
static const double HUB_TOLERANCE = 1e-6;

// ---- geometry ----

static int read_head_angle(const bike_yaml *yaml, const bike_field *field, void *target) {
  const int code = bike_yaml_number(yaml, field, target);
  char what[BIKE_ANGLE_TEXT];
  if (code || bike_angle_check(what, &bike_head_angle_range, *(double *)target)) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER, "%s", what);
}

static int read_measures(const bike_yaml *yaml, const bike_field *field, bike_description *d) {
  static const bike_key keys[] = {
      {"wheelbase", bike_yaml_positive, offsetof(bike_measures, wheelbase), true},
      {"trail", bike_yaml_number, offsetof(bike_measures, trail), true},
      {"head_angle", read_head_angle, offsetof(bike_measures, head_angle), true},
      {"rear_radius", bike_yaml_positive, offsetof(bike_measures, rear_radius), true},
      {"front_radius", bike_yaml_positive, offsetof(bike_measures, front_radius), true},
  };
  const int code = bike_yaml_read(yaml, field, field->value, (bike_keys){keys, 5}, &d->measures);
  if (!code) d->geometry = bike_geometry_of_measures(&d->measures);
  return code;
}

bike_geometry bike_geometry_of_measures(const bike_measures *m) {
  return bike_geometry_from_wheelbase(m->wheelbase, m->trail, M_PI / 2 - m->head_angle,
                                      m->rear_radius, m->front_radius);
}

static int read_lengths(const bike_yaml *yaml, const bike_field *field, bike_geometry *out) {
  static const bike_key keys[] = {
      {"L_r", bike_yaml_number, offsetof(bike_geometry, L_r), true},
      {"L_f", bike_yaml_number, offsetof(bike_geometry, L_f), true},
      {"L_s", bike_yaml_number, offsetof(bike_geometry, L_s), true},
      {"R_r", bike_yaml_positive, offsetof(bike_geometry, R_r), true},
      {"R_f", bike_yaml_positive, offsetof(bike_geometry, R_f), true},
  };
  return bike_yaml_read(yaml, field, field->value, (bike_keys){keys, 5}, out);
}

// The first key tells which of the two sets the file uses.
static int read_geometry(const bike_yaml *yaml, const bike_field *field, void *target) {
  bike_description *d = target;
  d->geometry_field = *field;
  const int code = bike_yaml_expect_mapping(yaml, field);
  if (code) return code;
  void *cursor = NULL;
  bike_field first = {.key = ""};
  bike_yaml_next(field->value, &cursor, &first);
  d->by_lengths = strncmp(first.key, "L_", 2) == 0 || strncmp(first.key, "R_", 2) == 0;
  return d->by_lengths ? read_lengths(yaml, field, &d->geometry) : read_measures(yaml, field, d);
}

// ---- parts ----

static int read_part_name(const bike_yaml *yaml, const bike_field *field, void *target) {
  bike_component *c = target;
  return bike_yaml_text(yaml, field, c->part.name, sizeof c->part.name);
}

static int read_assembly(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const char *const words[] = {"rear", "rear_wheel", "front", "front_wheel"};
  static const bike_assembly assemblies[] = {BIKE_REAR_FRAME, BIKE_REAR_WHEEL, BIKE_FRONT_FRAME,
                                             BIKE_FRONT_WHEEL};
  bike_component *c = target;
  for (int i = 0; i < 4; ++i) {
    if (!bike_yaml_is_text(field, words[i])) continue;
    c->part.assembly = assemblies[i];
    return BIKE_OK;
  }
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX,
                        "must be rear, front, rear_wheel or front_wheel");
}

static int read_position(const bike_yaml *yaml, const bike_field *field, void *target) {
  bike_component *c = target;
  c->has_position = true;
  return bike_yaml_numbers(yaml, field, c->part.position, 3);
}

static int read_theta(const bike_yaml *yaml, const bike_field *field, bike_component *c,
                      bike_inertia_kind kind) {
  c->kind = kind;
  return bike_yaml_not_negative(yaml, field, &c->theta);
}

static int read_inertia(const bike_yaml *yaml, const bike_field *field, void *target) {
  bike_component *c = target;
  if (bike_yaml_is_text(field, "none")) return BIKE_OK;
  static const char kinds[] = "must be none, or one of spin: T, steering: T, full: [Ixx, Iyy, Izz, "
                              "Ixy, Ixz, Iyz]";
  void *cursor = NULL;
  bike_field inner, more;
  if (!bike_yaml_is_mapping(field) || !bike_yaml_next(field->value, &cursor, &inner) ||
      bike_yaml_next(field->value, &cursor, &more))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "%s", kinds);
  if (strcmp(inner.key, "spin") == 0) return read_theta(yaml, &inner, c, BIKE_INERTIA_SPIN);
  if (strcmp(inner.key, "steering") == 0) return read_theta(yaml, &inner, c, BIKE_INERTIA_STEERING);
  if (strcmp(inner.key, "full") != 0)
    return bike_yaml_fail(yaml, &inner, BIKE_ERROR_SYNTAX, "unknown key: inertia %s", kinds);
  c->kind = BIKE_INERTIA_FULL;
  return bike_yaml_numbers(yaml, &inner, c->part.inertia, 6);
}

static int read_component(const bike_yaml *yaml, const bike_field *entry, bike_component *out) {
  static const bike_key keys[] = {
      {"name", read_part_name, 0, true},
      {"assembly", read_assembly, 0, true},
      {"mass", bike_yaml_positive, offsetof(bike_component, part.mass), true},
      {"position", read_position, 0, false},
      {"inertia", read_inertia, 0, true},
      {"rider", bike_yaml_flag, offsetof(bike_component, part.rider), false},
  };
  const int code = bike_yaml_expect_mapping(yaml, entry);
  out->field = *entry;
  return code ? code : bike_yaml_read(yaml, entry, entry->value, (bike_keys){keys, 6}, out);
}

static int read_parts(const bike_yaml *yaml, const bike_field *field, void *target) {
  bike_description *d = target;
  d->parts_field = *field;
  int code = bike_yaml_expect_list(yaml, field);
  void *cursor = NULL;
  bike_field entry = *field;
  while (!code && bike_yaml_next_entry(field->value, &cursor, &entry)) {
    if (d->count == BIKE_MAX_PARTS)
      return bike_yaml_fail(yaml, &entry, BIKE_ERROR_PARAMETER, "more than %d parts",
                            BIKE_MAX_PARTS);
    code = read_component(yaml, &entry, &d->parts[d->count++]);
  }
  return code;
}

// ---- the bicycle of the description ----

// Theta e e^T: about the hub axis e = left, or about the steering axis e_S = (-sin tilt, 0, cos
// tilt).
void bike_component_tensor(bike_component *c, double tilt) {
  double *inertia = c->part.inertia;
  if (c->kind == BIKE_INERTIA_SPIN) inertia[1] = c->theta;
  if (c->kind != BIKE_INERTIA_STEERING) return;
  inertia[0] = c->theta * sin(tilt) * sin(tilt);
  inertia[2] = c->theta * cos(tilt) * cos(tilt);
  inertia[4] = -c->theta * sin(tilt) * cos(tilt);
}

static bike_field part_field(const bike_component *c, const char *key) {
  bike_field field = c->field;
  bike_yaml_find(c->field.value, key, &field);
  return field;
}

static int place_part(const bike_yaml *yaml, bike_component *c, const bike_upright *upright) {
  const bool rear = c->part.assembly == BIKE_REAR_WHEEL;
  if (!rear && c->part.assembly != BIKE_FRONT_WHEEL) {
    if (c->has_position) return BIKE_OK;
    return bike_yaml_fail(yaml, &c->field, BIKE_ERROR_SYNTAX,
                          "key 'position' of part '%s' is missing", c->part.name);
  }
  const double *hub = rear ? upright->rear_hub : upright->front_hub;
  for (int k = 0; k < 3; ++k) {
    if (c->has_position && !(fabs(c->part.position[k] - hub[k]) <= HUB_TOLERANCE)) {
      const bike_field field = part_field(c, "position");
      return bike_yaml_fail(yaml, &field, BIKE_ERROR_PARAMETER,
                            "a wheel's position must be its hub, [%.9g, %.9g, %.9g]", hub[0],
                            hub[1], hub[2]);
    }
    c->part.position[k] = hub[k];
  }
  return BIKE_OK;
}

// The line to blame for a rule of bike_check, which begins with the member it is about.
static int component_line(int part, const char *rule, const char **key, const void *user) {
  const bike_description *d = user;
  bike_field field = part >= 0 ? d->parts[part].field : d->parts_field;
  char word[16];
  snprintf(word, sizeof word, "%.*s", (int)strcspn(rule, " "), rule);
  if (part >= 0) field = part_field(&d->parts[part], word);
  *key = field.key;
  return field.line;
}

static int check_plausible(const bike_yaml *yaml, const bike_description *d,
                           const bike_bicycle *bicycle) {
  bike_doubt doubt;
  if (!bike_has_doubt(&doubt, bicycle)) return BIKE_OK;
  const bike_field field =
      doubt.part < 0 ? d->geometry_field : part_field(&d->parts[doubt.part], "position");
  return bike_yaml_fail(yaml, &field, BIKE_ERROR_PARAMETER, "%s%s", doubt.text,
                        doubt.below_ground ? ": positions are [forward, left, up]" : "");
}

static int build(bike_bicycle *out, bike_description *d, const bike_yaml *yaml) {
  bike_upright upright;
  const int impossible = bike_upright_position(&upright, &d->geometry);
  if (impossible)
    return bike_yaml_fail(yaml, &d->geometry_field, impossible, "%s",
                          bike_error_string(impossible));
  bike_bicycle bicycle = bike_default_bicycle();
  bicycle.geometry = d->geometry;
  bicycle.gravity = d->gravity;
  bicycle.steer_damping = d->steer_damping;
  bicycle.part_count = d->count;
  memcpy(bicycle.name, d->name, sizeof bicycle.name);
  for (int i = 0; i < d->count; ++i) {
    bike_component_tensor(&d->parts[i], upright.tilt);
    const int code = place_part(yaml, &d->parts[i], &upright);
    if (code) return code;
    bicycle.parts[i] = d->parts[i].part;
  }
  int code = bike_report_check(&bicycle, yaml->path, component_line, d, yaml->error);
  if (!code) code = check_plausible(yaml, d, &bicycle);
  if (!code) *out = bicycle;
  return code;
}

static int read_name(const bike_yaml *yaml, const bike_field *field, void *target) {
  return bike_yaml_text(yaml, field, target, BIKE_NAME_SIZE);
}

int bike_read_components(bike_bicycle *out, bike_description *d, const bike_yaml *yaml) {
  static const bike_key keys[] = {
      {"parameterization", bike_yaml_ignored_text, 0, true}, // what brought us here
      {"name", read_name, offsetof(bike_description, name), false},
      {"description", bike_yaml_ignored_text, 0, false},
      {"g", bike_yaml_positive, offsetof(bike_description, gravity), true},
      {"steer_damping", bike_yaml_not_negative, offsetof(bike_description, steer_damping), false},
      {"geometry", read_geometry, 0, true},
      {"parts", read_parts, 0, true},
  };
  *d = (bike_description){0};
  const int code = bike_yaml_read(yaml, NULL, yaml->root, (bike_keys){keys, 7}, d);
  return code ? code : build(out, d, yaml);
}
