// SPDX-License-Identifier: Apache-2.0
#include "plausible.h"

#include <math.h>
#include <stdio.h>

// The tolerance is that of the rounding of a conversion.
static bool find_below_ground(bike_doubt *out, const bike_bicycle *b, double wheelbase) {
  for (int i = 0; i < b->part_count; ++i) {
    const double up = b->parts[i].position[2];
    if (up >= -1e-6 * wheelbase) continue;
    *out = (bike_doubt){.part = i, .below_ground = true};
    snprintf(out->text, sizeof out->text, "the mass centre would be %.6g m below the ground", -up);
    return true;
  }
  return false;
}

static bool is_wheel(const bike_part *part) { // whose place is its hub
  return part->assembly == BIKE_REAR_WHEEL || part->assembly == BIKE_FRONT_WHEEL;
}

// The largest length, and in `part` whose it is.
static double largest_length(int *part, const bike_bicycle *b, double wheelbase) {
  double largest = fmax(wheelbase, fmax(b->geometry.R_r, b->geometry.R_f));
  *part = -1;
  for (int i = 0; i < b->part_count; ++i)
    for (int k = 0; k < 3; ++k) {
      if (is_wheel(&b->parts[i]) || fabs(b->parts[i].position[k]) <= largest) continue;
      largest = fabs(b->parts[i].position[k]);
      *part = i;
    }
  return largest;
}

static bool find_other_unit(bike_doubt *out, const bike_bicycle *b, double wheelbase) {
  static const double least_density = 1e-3, shortest = 10; // kg/m^3, m
  double mass = 0;
  int part;
  for (int i = 0; i < b->part_count; ++i) mass += b->parts[i].mass;
  const double length = largest_length(&part, b, wheelbase);
  if (!(length > shortest && mass < least_density * length * length * length)) return false;
  *out = (bike_doubt){.part = part};
  snprintf(out->text, sizeof out->text,
           "%.6g m in a bicycle of %.6g kg: lengths are in metres, these look like %s", length,
           mass, length > 500 ? "millimetres" : "centimetres"); // of 0.5 to 5 m
  return true;
}

bool bike_has_doubt(bike_doubt *out, const bike_bicycle *bicycle) {
  bike_upright upright;
  if (bike_upright_position(&upright, &bicycle->geometry)) return false; // bike_check's to refuse
  return find_below_ground(out, bicycle, upright.wheelbase) ||
         find_other_unit(out, bicycle, upright.wheelbase);
}
