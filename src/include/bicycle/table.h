// SPDX-License-Identifier: Apache-2.0
// Rides as CSV: a header, then one row a sample, %.17g, so that every double comes back.
#ifndef BICYCLE_TABLE_H
#define BICYCLE_TABLE_H

#include <bicycle/ride.h>
#include <stdio.h>

// Signs of what is written.
typedef enum bike_convention {
  BIKE_CONVENTION_ISO, // steer, yaw and y left positive, as everywhere in this library
  BIKE_CONVENTION_SAE  // steer, yaw and y right positive, as in the literature; lean is the same
} bike_convention;

// The columns, of bike_sample in its order: "time", "x", ... "front_friction".
enum { BIKE_COLUMN_COUNT = 17 };
BIKE_API const char *const *bike_column_names(void);

// A sample's columns in order: SI and radians, in the convention asked.
BIKE_API void bike_columns(double out[BIKE_COLUMN_COUNT], const bike_sample *sample,
                           bike_convention convention);

// One line each, ended by a line feed, whatever the locale. What is not finite (friction without a
// normal force) is written as nan or inf. Write errors stay in the stream: bike_output_commit
// reports them.
BIKE_API void bike_table_header(FILE *stream);
BIKE_API void bike_table_row(FILE *stream, const bike_sample *sample, bike_convention convention);

#endif
