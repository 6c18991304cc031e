// SPDX-License-Identifier: Apache-2.0
// A bicycle as BicycleParameters reads it: `parameterization: Meijaard2007`.
//
// Its reader asks for the keys `rider` and `values`, for a speed `v` among them, and for values
// that YAML 1.1 takes for floating-point numbers. What the form has no symbol for stands in keys
// that it passes over: steer_damping and rider_share.
#include "meijaard.h"
#include "message.h"
#include "number.h"
#include "tensor.h"

#include <bicycle/error.h>
#include <bicycle/file.h>
#include <bicycle/output.h>
#include <math.h>

// Of the trace: products of inertia this small are rounding of a symmetric bicycle.
static const double PRODUCT_ROUNDING = 1e-12;

// The rear and front frame and the wheels, lumped.
typedef struct lumps {
  bike_lump B, H, R, F;
} lumps;

static const char *lost_by(const bike_lump *lump) {
  const double *I = lump->inertia;
  if (!(lump->mass > 0)) return "a frame or wheel without mass";
  const double limit = PRODUCT_ROUNDING * (I[0] + I[1] + I[2]);
  if (!(fabs(I[3]) <= limit && fabs(I[5]) <= limit)) return "a product of inertia Ixy or Iyz";
  return NULL;
}

static const char *first_lost(const lumps *l) {
  const bike_lump *const all[4] = {&l->B, &l->H, &l->R, &l->F};
  for (int i = 0; i < 4; ++i)
    if (lost_by(all[i])) return lost_by(all[i]);
  return NULL;
}

static void set_body(double *value, int x, const bike_lump *lump) {
  // x, z, m, Ixx, Iyy, Izz, Ixz stand in this order for B and for H
  value[x] = lump->centre[0];
  value[x + 1] = -lump->centre[2];
  value[x + 2] = lump->mass;
  for (int k = 0; k < 3; ++k) value[x + 3 + k] = lump->inertia[k];
  value[x + 6] = 0 - lump->inertia[4]; // never a negative zero
}

// r, m, Ixx, Iyy of a wheel
static void set_wheel(double *value, int r, double radius, const bike_lump *lump) {
  value[r] = radius;
  value[r + 1] = lump->mass;
  value[r + 2] = lump->inertia[0];
  value[r + 3] = lump->inertia[1];
}

static int lump_bicycle(lumps *out, const bike_bicycle *bicycle) {
  out->B = bike_lump_parts(bicycle, BIKE_REAR_FRAME);
  out->H = bike_lump_parts(bicycle, BIKE_FRONT_FRAME);
  out->R = bike_lump_parts(bicycle, BIKE_REAR_WHEEL);
  out->F = bike_lump_parts(bicycle, BIKE_FRONT_WHEEL);
  return first_lost(out) ? BIKE_ERROR_PARAMETER : BIKE_OK;
}

int bike_to_meijaard(double value[BIKE_MEIJAARD_COUNT], const bike_bicycle *bicycle) {
  bike_upright upright;
  lumps l;
  int code = bike_check(bicycle, NULL, NULL);
  if (!code) code = bike_upright_position(&upright, &bicycle->geometry);
  if (!code) code = lump_bicycle(&l, bicycle);
  if (code) return code;
  value[MEIJAARD_W] = upright.wheelbase;
  value[MEIJAARD_C] = upright.trail;
  value[MEIJAARD_LAM] = upright.tilt;
  value[MEIJAARD_G] = bicycle->gravity;
  set_wheel(value, MEIJAARD_RR, bicycle->geometry.R_r, &l.R);
  set_wheel(value, MEIJAARD_RF, bicycle->geometry.R_f, &l.F);
  set_body(value, MEIJAARD_XB, &l.B);
  set_body(value, MEIJAARD_XH, &l.H);
  return BIKE_OK;
}

static void write_number(FILE *stream, const char *key, double value) {
  char text[BIKE_NUMBER_SIZE];
  bike_number_print_point(text, value);
  fprintf(stream, "  %s: %s\n", key, text);
}

// A text as a quoted YAML scalar.
static void write_quoted(FILE *stream, const char *text) {
  fputc('\'', stream);
  for (; *text; ++text) {
    if (*text == '\'') fputc('\'', stream);
    fputc((unsigned char)*text < 0x20 || *text == 0x7f ? '?' : *text, stream);
  }
  fputc('\'', stream);
}

static const bike_part *rider_of(const bike_bicycle *bicycle) {
  for (int i = 0; i < bicycle->part_count; ++i)
    if (bicycle->parts[i].rider) return &bicycle->parts[i];
  return NULL;
}

static void write_head(FILE *stream, const bike_bicycle *bicycle) {
  fputs("# Meijaard, Papadopoulos, Ruina, Schwab (2007): SI and radians; x forward, y right and\n"
        "# z down from the rear contact; B rear frame with the rider, H front frame, R and F "
        "wheels.\n"
        "parameterization: Meijaard2007\n"
        "parameters: ",
        stream);
  write_quoted(stream, bicycle->name);
  const bike_part *rider = rider_of(bicycle);
  // without a rider of its own B may still hold one: the benchmark's does
  fprintf(stream, "\nrider: %s\n", rider ? "true" : "null");
  if (rider) {
    fputs("rider_share: # mass and place of the rider within B\n", stream);
    write_number(stream, "mP", rider->mass);
    write_number(stream, "xP", rider->position[0]);
    write_number(stream, "yP", 0 - rider->position[1]);
    write_number(stream, "zP", 0 - rider->position[2]);
  }
  if (bicycle->steer_damping > 0) {
    char text[BIKE_NUMBER_SIZE];
    bike_number_print_point(text, bicycle->steer_damping);
    fprintf(stream, "steer_damping: %s # N m s/rad\n", text);
  }
}

static void write_values(FILE *stream, const double value[BIKE_MEIJAARD_COUNT],
                         const bike_bicycle *bicycle) {
  fputs("values:\n", stream);
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; ++i)
    write_number(stream, bike_meijaard_symbols()[i], value[i]);
  const bike_lump B = bike_lump_parts(bicycle, BIKE_REAR_FRAME);
  const bike_lump H = bike_lump_parts(bicycle, BIKE_FRONT_FRAME);
  if (B.centre[1] != 0) write_number(stream, "yB", -B.centre[1]);
  if (H.centre[1] != 0) write_number(stream, "yH", -H.centre[1]);
  fputs("  v: 1.0 # not of the bicycle: BicycleParameters asks for a speed\n", stream);
}

int bike_file_write(const bike_bicycle *bicycle, const char *path, bike_file_error *error) {
  const char *shown = path ? path : "-";
  double value[BIKE_MEIJAARD_COUNT];
  const char *rule = NULL;
  int code = bike_check(bicycle, NULL, &rule);
  if (code) return bike_message(error, code, "%s: not written: %s", shown, rule);
  code = bike_to_meijaard(value, bicycle);
  if (code) {
    lumps l;
    lump_bicycle(&l, bicycle);
    return bike_message(error, code, "%s: not written: Meijaard2007 cannot hold %s", shown,
                        first_lost(&l) ? first_lost(&l) : bike_error_string(code));
  }
  bike_output output;
  code = bike_output_begin(&output, path, error);
  if (code) return code;
  write_head(output.stream, bicycle);
  write_values(output.stream, value, bicycle);
  return bike_output_commit(&output, error);
}
