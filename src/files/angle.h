// SPDX-License-Identifier: Apache-2.0
// Angles in files: radians, where people think in degrees.
#ifndef FILES_ANGLE_H
#define FILES_ANGLE_H

#include <stdbool.h>
#include <stddef.h>

// What an angle may be; neither end is.
typedef struct bike_angle_range {
  double low, high;  // rad
  const char *words; // "between LOW and HIGH"
} bike_angle_range;

extern const bike_angle_range bike_head_angle_range; // from the horizontal
extern const bike_angle_range bike_tilt_range;       // from the vertical: steering axis, lean
extern const bike_angle_range bike_steer_range;
extern const bike_angle_range bike_turns_range; // any lean or steer: BIKE_LARGEST_ANGLE

enum { BIKE_ANGLE_TEXT = 128 };

// Whether it is one. If not, `what` tells what it must be, and, of a number that may well be one of
// degrees, what that is in radians.
bool bike_angle_check(char what[BIKE_ANGLE_TEXT], const bike_angle_range *range, double angle);

// Of a text that is no number: ": angles are in radians, 18 deg are 0.314159" if it is one with a
// unit behind it ("18deg", "18 degrees"); empty if it is not.
void bike_angle_hint(char out[BIKE_ANGLE_TEXT], const char *text, size_t length);

#endif
