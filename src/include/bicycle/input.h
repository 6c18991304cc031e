// SPDX-License-Identifier: Apache-2.0
// Inputs of a ride read from a CSV file: torques and the rider's motion as functions of time.
//
// The file has a header naming its columns in any order: `time` (s) and any of `steer_torque` (N
// m), `roll_torque` (N m), `rider_offset` (m); then numbers, at least two rows, time strictly
// rising. Between the rows torques are linear. The rider's offset is the cubic spline through its
// values (not-a-knot; a parabola through three, a line through two): the equations need its
// velocity and acceleration, which the spline keeps continuous.
#ifndef BICYCLE_INPUT_H
#define BICYCLE_INPUT_H

#include <bicycle/file.h>
#include <bicycle/ride.h>
#include <stddef.h>

typedef struct bike_input_table bike_input_table;

// Reads a file that must cover 0 <= time <= duration (s). BIKE_ERROR_FILE, BIKE_ERROR_SYNTAX,
// BIKE_ERROR_PARAMETER (it ends too early) or BIKE_ERROR_MEMORY with one line in `error` (may be
// NULL); `*out` is NULL then.
BIKE_API int bike_input_table_create(bike_input_table **out, const char *path, double duration,
                                     bike_file_error *error);
BIKE_API void bike_input_table_free(bike_input_table *table);

// The input at a time: a bike_input_function whose `user` is the table. Outside the file's times
// the first and the last interval go on.
BIKE_API void bike_input_table_at(double time, bike_input *out, void *table);

// Times at which the input is not smooth: those of the rows. Valid as long as the table.
BIKE_API const double *bike_input_table_times(const bike_input_table *table, size_t *count);

// Whether the file moves the rider: a column rider_offset.
BIKE_API bool bike_input_table_has_rider(const bike_input_table *table);

#endif
