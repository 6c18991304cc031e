// SPDX-License-Identifier: Apache-2.0
#include "angle.h"

#include "number.h"

#include <bicycle/state.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double DEGREE = M_PI / 180;

const bike_angle_range bike_head_angle_range = {0, M_PI, "between 0 and pi (pi/2: upright)"};
const bike_angle_range bike_tilt_range = {-M_PI / 2, M_PI / 2, "between -pi/2 and pi/2"};
const bike_angle_range bike_steer_range = {-M_PI, M_PI, "between -pi and pi"};
const bike_angle_range bike_turns_range = {-BIKE_LARGEST_ANGLE, BIKE_LARGEST_ANGLE,
                                           "within 100 turns"};

static bool is_within(const bike_angle_range *range, double angle) {
  return angle > range->low && angle < range->high;
}

bool bike_angle_check(char what[BIKE_ANGLE_TEXT], const bike_angle_range *range, double angle) {
  if (is_within(range, angle)) return true;
  const int used = snprintf(what, BIKE_ANGLE_TEXT, "must be in radians, %s", range->words);
  if (is_within(range, angle * DEGREE))
    snprintf(what + used, BIKE_ANGLE_TEXT - (size_t)used, "; %g deg are %.6g", angle,
             angle * DEGREE);
  return false;
}

void bike_angle_hint(char out[BIKE_ANGLE_TEXT], const char *text, size_t length) {
  static const char *const units[] = {"degrees", "degree", "deg", "\u00b0"};
  double angle;
  out[0] = '\0';
  for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
    const size_t unit = strlen(units[i]);
    if (length <= unit || memcmp(text + length - unit, units[i], unit) != 0) continue;
    length -= unit;
    while (length > 0 && text[length - 1] == ' ') length--;
    if (bike_number_parse(&angle, text, length) == NULL)
      snprintf(out, BIKE_ANGLE_TEXT, ": angles are in radians, %g deg are %.6g", angle,
               angle * DEGREE);
    return;
  }
}
