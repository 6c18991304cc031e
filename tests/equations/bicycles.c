// SPDX-License-Identifier: Apache-2.0
#include "bicycles.h"
#include "support/near.h"
#include <bicycle/file.h>

#define DEGREE 0.017453292519943295

// |lean| <= 45 deg, |steer| <= 60 deg, rates to 2 rad/s, 1 to 10 m/s; the penny-farthing's geometry
// ends earlier.
#define MODERN                                                                                     \
  { 45 * DEGREE, 60 * DEGREE, 2, 1, 10 }
const shipped_bicycle shipped_bicycles[SHIPPED_COUNT] = {
    {"roadster", MODERN},         {"roadster_riderless", MODERN},
    {"benchmark", MODERN},        {"recumbent", MODERN},
    {"recumbent_damped", MODERN}, {"penny_farthing", {35 * DEGREE, 45 * DEGREE, 2, 1, 10}},
};

bike_bicycle read_shipped(const char *name) {
  char path[512];
  snprintf(path, sizeof path, "%s/model/%s/%s.yml", BICYCLE_SOURCE_DIR, name, name);
  bike_file file;
  bike_file_error error;
  if (bike_file_read(&file, path, &error) != 0) fail_msg("%s", error.text);
  return file.bicycle;
}

// B B^T of a random B, so positive semidefinite; without products to the side when symmetric.
static void random_tensor(random_source *source, double size, bool symmetric, double out[6]) {
  double b[3][3], t[3][3];
  for (int i = 0; i < 9; i++) b[i / 3][i % 3] = random_between(source, -1, 1) * sqrt(size / 3);
  if (symmetric) b[0][1] = b[1][0] = b[1][2] = b[2][1] = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) t[i][j] = b[i][0] * b[j][0] + b[i][1] * b[j][1] + b[i][2] * b[j][2];
  const double packed[6] = {t[0][0], t[1][1], t[2][2], t[0][1], t[0][2], t[1][2]};
  for (int i = 0; i < 6; i++) out[i] = packed[i];
}

static void add_wheel(bike_bicycle *b, random_source *source, bike_assembly assembly,
                      const double hub[3]) {
  bike_part *part = &b->parts[b->part_count++];
  *part = (bike_part){.assembly = assembly, .mass = random_between(source, 0.5, 5)};
  snprintf(part->name, sizeof part->name, "%s wheel",
           assembly == BIKE_REAR_WHEEL ? "rear" : "front");
  for (int i = 0; i < 3; i++) part->position[i] = hub[i];
  part->inertia[0] = part->inertia[2] = random_between(source, 0, 0.3);
  part->inertia[1] = random_between(source, 0, 0.6);
}

static void add_part(bike_bicycle *b, random_source *source, bike_assembly assembly, bool rider,
                     bool symmetric) {
  bike_part *part = &b->parts[b->part_count];
  *part = (bike_part){.assembly = assembly, .rider = rider};
  snprintf(part->name, sizeof part->name, "part %d", b->part_count++);
  bool front = assembly == BIKE_FRONT_FRAME;
  part->mass = random_between(source, 1, rider ? 80 : 15);
  part->position[0] = front ? random_between(source, 0.6, 1.2) : random_between(source, 0, 0.8);
  part->position[1] = symmetric ? 0 : random_between(source, -0.2, 0.2);
  part->position[2] = random_between(source, 0.3, 1.4);
  random_tensor(source, front ? 0.3 : 4, symmetric, part->inertia);
}

bike_bicycle random_bicycle(random_source *source, bool symmetric) {
  bike_bicycle b = bike_default_bicycle();
  snprintf(b.name, sizeof b.name, "random");
  b.geometry = bike_geometry_from_wheelbase(
      random_between(source, 0.9, 1.4), random_between(source, -0.05, 0.15),
      random_between(source, 0, 0.5), random_between(source, 0.2, 0.4),
      random_between(source, 0.2, 0.4));
  b.gravity = random_between(source, 1.6, 20);
  b.steer_damping = random_between(source, 0, 2);
  bike_upright upright;
  assert_int_equal(bike_upright_position(&upright, &b.geometry), 0);
  add_wheel(&b, source, BIKE_REAR_WHEEL, upright.rear_hub);
  add_wheel(&b, source, BIKE_FRONT_WHEEL, upright.front_hub);
  add_part(&b, source, BIKE_REAR_FRAME, false, symmetric);
  add_part(&b, source, BIKE_REAR_FRAME, true, symmetric);
  add_part(&b, source, BIKE_FRONT_FRAME, false, symmetric);
  add_part(&b, source, BIKE_FRONT_FRAME, false, symmetric);
  return b;
}

bike_bicycle mirrored(const bike_bicycle *bicycle) {
  bike_bicycle b = *bicycle;
  for (int i = 0; i < b.part_count; i++) {
    b.parts[i].position[1] *= -1;
    b.parts[i].inertia[3] *= -1; // Ixy
    b.parts[i].inertia[5] *= -1; // Iyz
  }
  return b;
}
