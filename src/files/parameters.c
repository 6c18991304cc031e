// SPDX-License-Identifier: Apache-2.0
// Numbers of a file by name. Each is a double within bike_source at a known offset, so that a
// changed bicycle is a changed copy of the source, made anew.
#include <bicycle/error.h>
#include <bicycle/parameters.h>

#include "message.h"
#include "parameters_build.h"
#include "source.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// 7 of the file, and of each part a mass, a place and a tensor: more than Meijaard's 35.
enum { MOST_NUMBERS = 7 + BIKE_MAX_PARTS * 10 };

typedef struct file_number {
  char name[BIKE_FILE_NUMBER_SIZE];
  size_t offset; // in bike_source
  double sigma;
} file_number;

struct bike_parameters {
  bike_source source;
  char name[BIKE_NAME_SIZE]; // of the bicycle
  int count;
  file_number numbers[MOST_NUMBERS];
};

// Adds the number that stands at `place` within the source.
static void add(bike_parameters *p, const double *place, double sigma, const char *format,
                const char *first, const char *second) {
  file_number *n = &p->numbers[p->count++];
  snprintf(n->name, sizeof n->name, format, first, second);
  n->offset = (size_t)((const char *)place - (const char *)&p->source);
  n->sigma = sigma;
}

static void list_symbols(bike_parameters *p) {
  bike_symbols *s = &p->source.symbols;
  for (int i = 0; i <= MEIJAARD_YH; i++)
    add(p, &s->value[i], s->sigma[i], "%s%s", bike_symbol_name(i), "");
  add(p, &s->steer_damping, 0, "%s%s", "steer_damping", "");
  if (!s->rider.given) return;
  static const char *const axes[] = {"xP", "yP", "zP"};
  add(p, &s->rider.mass, 0, "%s.%s", "rider_share", "mP");
  for (int k = 0; k < 3; k++) add(p, &s->rider.position[k], 0, "%s.%s", "rider_share", axes[k]);
}

static void list_geometry(bike_parameters *p) {
  static const char *const measures[] = {"wheelbase", "trail", "head_angle", "rear_radius",
                                         "front_radius"};
  static const char *const lengths[] = {"L_r", "L_f", "L_s", "R_r", "R_f"};
  bike_description *d = &p->source.description;
  bike_measures *m = &d->measures;
  bike_geometry *g = &d->geometry;
  const double *measured[] = {&m->wheelbase, &m->trail, &m->head_angle, &m->rear_radius,
                              &m->front_radius};
  const double *given[] = {&g->L_r, &g->L_f, &g->L_s, &g->R_r, &g->R_f};
  for (int i = 0; i < 5; i++)
    add(p, d->by_lengths ? given[i] : measured[i], 0, "%s.%s", "geometry",
        d->by_lengths ? lengths[i] : measures[i]);
}

static void list_inertia(bike_parameters *p, bike_component *c, bool wheel) {
  static const char *const tensor[] = {"Ixx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz"};
  const char *name = c->part.name;
  if (c->kind == BIKE_INERTIA_SPIN) add(p, &c->theta, 0, "parts.%s.inertia.%s", name, "spin");
  if (c->kind == BIKE_INERTIA_STEERING)
    add(p, &c->theta, 0, "parts.%s.inertia.%s", name, "steering");
  for (int k = 0; c->kind == BIKE_INERTIA_FULL && k < (wheel ? 2 : 6); k++)
    add(p, &c->part.inertia[k], 0, "parts.%s.inertia.%s", name, tensor[k]);
}

static void list_part(bike_parameters *p, bike_component *c) {
  static const char *const axes[] = {"forward", "left", "up"};
  const bool wheel = parameters_is_wheel(c);
  add(p, &c->part.mass, 0, "parts.%s.%s", c->part.name, "mass");
  for (int k = 0; !wheel && k < 3; k++)
    add(p, &c->part.position[k], 0, "parts.%s.position.%s", c->part.name, axes[k]);
  list_inertia(p, c, wheel);
}

static void list_components(bike_parameters *p) {
  bike_description *d = &p->source.description;
  add(p, &d->gravity, 0, "%s%s", "g", "");
  add(p, &d->steer_damping, 0, "%s%s", "steer_damping", "");
  list_geometry(p);
  for (int i = 0; i < d->count; i++) list_part(p, &d->parts[i]);
}

int bike_parameters_read(bike_parameters **out, bike_file *file, const char *path,
                         bike_file_error *error) {
  if (!out || !file) return BIKE_ERROR_ARGUMENT;
  *out = NULL;
  bike_parameters *p = calloc(1, sizeof *p);
  if (!p) return bike_message(error, BIKE_ERROR_MEMORY, "out of memory");
  const int code = bike_source_read(file, &p->source, path, error);
  if (code) {
    free(p);
    return code;
  }
  memcpy(p->name, file->bicycle.name, sizeof p->name);
  if (p->source.literature)
    list_symbols(p);
  else
    list_components(p);
  *out = p;
  return BIKE_OK;
}

void bike_parameters_free(bike_parameters *parameters) {
  free(parameters);
}

int bike_parameters_count(const bike_parameters *p) {
  return p->count;
}

const char *bike_parameters_name(const bike_parameters *p, int index) {
  return p->numbers[index].name;
}

double bike_parameters_value(const bike_parameters *p, int index) {
  double value;
  memcpy(&value, (const char *)&p->source + p->numbers[index].offset, sizeof value);
  return value;
}

double bike_parameters_sigma(const bike_parameters *p, int index) {
  return p->numbers[index].sigma;
}

int bike_parameters_find(const bike_parameters *p, const char *name) {
  for (int i = 0; i < p->count; i++)
    if (strcmp(p->numbers[i].name, name) == 0) return i;
  return -1;
}

int bike_parameters_apply(bike_bicycle *out, const bike_parameters *p, const int *index,
                          const double *value, int count, bike_file_error *error) {
  if (!out || !p) return BIKE_ERROR_ARGUMENT;
  bike_source source = p->source;
  for (int i = 0; i < count; i++) {
    if (index[i] < 0 || index[i] >= p->count) return BIKE_ERROR_ARGUMENT;
    const file_number *n = &p->numbers[index[i]];
    if (!isfinite(value[i]))
      return bike_message(error, BIKE_ERROR_NOT_FINITE, "%s: must be finite", n->name);
    memcpy((char *)&source + n->offset, &value[i], sizeof value[i]);
  }
  bike_bicycle bicycle;
  const int code = source.literature
                       ? parameters_from_symbols(&bicycle, &source.symbols, error)
                       : parameters_from_description(&bicycle, &source.description, error);
  if (code) return code;
  memcpy(bicycle.name, p->name, sizeof bicycle.name);
  *out = bicycle;
  return BIKE_OK;
}
