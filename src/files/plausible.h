// SPDX-License-Identifier: Apache-2.0
// Numbers that the equations take but no bicycle on level ground has: an axis that points the other
// way, lengths in another unit than metres.
#ifndef FILES_PLAUSIBLE_H
#define FILES_PLAUSIBLE_H

#include <bicycle/bicycle.h>

typedef struct bike_doubt {
  int part;          // which part, -1: the bicycle's geometry
  bool below_ground; // its mass centre is; otherwise a length is too large for the mass
  char text[160];    // what is wrong, without a word about the file's convention
} bike_doubt;

// Whether a bicycle that passes bike_check is nevertheless none:
// - The mass centre of a part lies within its convex hull, hence not below the ground it stands on.
// - The mass over the cube of the largest length (wheelbase, radii, coordinates of mass centres) is
//   0.5 to 200 kg/m^3 for bicycles, of any size where the mass is that of the size, and at most
//   2e-4 kg/m^3 with lengths in centimetres, 2e-7 in millimetres. Below 1e-3, a thousandth of the
//   density of air, a length above 10 m is in another unit.
bool bike_has_doubt(bike_doubt *out, const bike_bicycle *bicycle);

#endif
