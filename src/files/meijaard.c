// SPDX-License-Identifier: Apache-2.0
// The symbols of Meijaard et al. (2007), table 1, and the bicycle they describe. Their axes are
// (x forward, y right, z down) from the rear contact; ours (forward, left, up).
#include "meijaard.h"

#include "angle.h"
#include "message.h"
#include "plausible.h"
#include "tensor.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const SYMBOLS[BIKE_MEIJAARD_COUNT + 1] = {
    "w",  "c",  "lam",  "g",                            // frame
    "rR", "mR", "IRxx", "IRyy",                         // rear wheel
    "xB", "zB", "mB",   "IBxx", "IByy", "IBzz", "IBxz", // rear frame
    "xH", "zH", "mH",   "IHxx", "IHyy", "IHzz", "IHxz", // front frame
    "rF", "mF", "IFxx", "IFyy",                         // front wheel
    NULL};

// Read besides the 26.
static const char *const MORE[MEIJAARD_ALL - BIKE_MEIJAARD_COUNT] = {"yB", "yH", "IRzz", "IFzz"};

const char *const *bike_meijaard_symbols(void) {
  return SYMBOLS;
}

const char *bike_symbol_name(int index) {
  return index < BIKE_MEIJAARD_COUNT ? SYMBOLS[index] : MORE[index - BIKE_MEIJAARD_COUNT];
}

// Symbols that other models of BicycleParameters need: the speed, Moore's lengths, the parts of a
// split front assembly (I?xx etc., m?, x?, z? for ? = G, S).
static bool is_unused(const char *name) {
  static const char *const words[] = {"v", "d1", "d2", "d3", "xcl", "zcl"};
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
    if (strcmp(name, words[i]) == 0) return true;
  const bool split = name[0] && (name[1] == 'G' || name[1] == 'S');
  if (split && name[0] == 'I') return strlen(name) == 4 && strspn(name + 2, "xyz") == 2;
  return split && strchr("mxz", name[0]) && !name[2];
}

int bike_symbol_index(const char *name) {
  for (int i = 0; i < MEIJAARD_ALL; ++i)
    if (strcmp(name, bike_symbol_name(i)) == 0) return i;
  return is_unused(name) ? BIKE_SYMBOL_UNUSED : BIKE_SYMBOL_UNKNOWN;
}

static bike_part make_part(const char *name, bike_assembly assembly, double mass, double x,
                           double z, double Ixx, double Iyy, double Izz, double Ixz) {
  bike_part part = {.assembly = assembly,
                    .mass = mass,
                    .position = {x, 0, -z},
                    .inertia = {Ixx, Iyy, Izz, 0, -Ixz, 0}}; // turned about x: the product's sign
  snprintf(part.name, sizeof part.name, "%s", name);
  return part;
}

int bike_from_meijaard(bike_bicycle *out, const double value[BIKE_MEIJAARD_COUNT]) {
  const double *p = value;
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; ++i)
    if (!isfinite(p[i])) return BIKE_ERROR_NOT_FINITE;
  // beyond, the steering axis points down and the length formulas mean something else
  if (!(fabs(p[MEIJAARD_LAM]) < M_PI / 2)) return BIKE_ERROR_PARAMETER;
  bike_bicycle bicycle = bike_default_bicycle();
  bicycle.gravity = p[MEIJAARD_G];
  bicycle.geometry = bike_geometry_from_wheelbase(p[MEIJAARD_W], p[MEIJAARD_C], p[MEIJAARD_LAM],
                                                  p[MEIJAARD_RR], p[MEIJAARD_RF]);
  bicycle.part_count = 4;
  bicycle.parts[0] =
      make_part("B", BIKE_REAR_FRAME, p[MEIJAARD_MB], p[MEIJAARD_XB], p[MEIJAARD_ZB],
                p[MEIJAARD_IBXX], p[MEIJAARD_IBYY], p[MEIJAARD_IBZZ], p[MEIJAARD_IBXZ]);
  bicycle.parts[1] = make_part("R", BIKE_REAR_WHEEL, p[MEIJAARD_MR], 0, -p[MEIJAARD_RR],
                               p[MEIJAARD_IRXX], p[MEIJAARD_IRYY], p[MEIJAARD_IRXX], 0);
  bicycle.parts[2] =
      make_part("H", BIKE_FRONT_FRAME, p[MEIJAARD_MH], p[MEIJAARD_XH], p[MEIJAARD_ZH],
                p[MEIJAARD_IHXX], p[MEIJAARD_IHYY], p[MEIJAARD_IHZZ], p[MEIJAARD_IHXZ]);
  bicycle.parts[3] =
      make_part("F", BIKE_FRONT_WHEEL, p[MEIJAARD_MF], p[MEIJAARD_W], -p[MEIJAARD_RF],
                p[MEIJAARD_IFXX], p[MEIJAARD_IFYY], p[MEIJAARD_IFXX], 0);
  *out = bicycle;
  return BIKE_OK;
}

// Splits the rear frame into "B" without its rider and a part "rider" of mass alone: the rider's
// own tensor stays with B, which the equations cannot tell from the rider's having it.
static bool split_rider(bike_bicycle *bicycle, const bike_rider_share *rider) {
  bike_part *frame = &bicycle->parts[0];
  bike_lump rest = bike_lump_parts(bicycle, BIKE_REAR_FRAME);
  const double position[3] = {rider->position[0], -rider->position[1], -rider->position[2]};
  if (!bike_take_point(&rest, rider->mass, position)) return false;
  frame->mass = rest.mass;
  memcpy(frame->position, rest.centre, sizeof frame->position);
  memcpy(frame->inertia, rest.inertia, sizeof frame->inertia);
  bike_part *part = &bicycle->parts[bicycle->part_count++];
  *part =
      (bike_part){.name = "rider", .assembly = BIKE_REAR_FRAME, .rider = true, .mass = rider->mass};
  memcpy(part->position, position, sizeof position);
  return true;
}

// ---- what was read ----

typedef struct reading {
  const bike_symbols *symbols;
  const char *path;
  bike_file_error *error;
} reading;

static int refuse(const reading *r, int symbol, int code, const char *what) {
  return bike_message_at(r->error, code, r->path, r->symbols->line[symbol],
                         bike_symbol_name(symbol), what);
}

static int check_range(const reading *r) {
  static const int positive[] = {MEIJAARD_W,  MEIJAARD_G,  MEIJAARD_RR, MEIJAARD_RF,
                                 MEIJAARD_MR, MEIJAARD_MB, MEIJAARD_MH, MEIJAARD_MF};
  static const int not_negative[] = {MEIJAARD_IRXX, MEIJAARD_IRYY, MEIJAARD_IFXX, MEIJAARD_IFYY,
                                     MEIJAARD_IBXX, MEIJAARD_IBYY, MEIJAARD_IBZZ, MEIJAARD_IHXX,
                                     MEIJAARD_IHYY, MEIJAARD_IHZZ};
  const double *value = r->symbols->value;
  for (size_t i = 0; i < sizeof positive / sizeof *positive; ++i)
    if (!(value[positive[i]] > 0))
      return refuse(r, positive[i], BIKE_ERROR_PARAMETER, "must be positive");
  for (size_t i = 0; i < sizeof not_negative / sizeof *not_negative; ++i)
    if (!(value[not_negative[i]] >= 0))
      return refuse(r, not_negative[i], BIKE_ERROR_PARAMETER, "must not be negative");
  char what[BIKE_ANGLE_TEXT];
  if (bike_angle_check(what, &bike_tilt_range, value[MEIJAARD_LAM])) return BIKE_OK;
  return refuse(r, MEIJAARD_LAM, BIKE_ERROR_PARAMETER, what);
}

// A wheel turns: its tensor must be the same about all its diameters.
static int check_wheel(const reading *r, int zz, int xx) {
  const bike_symbols *s = r->symbols;
  if (!s->line[zz] || s->value[zz] == s->value[xx]) return BIKE_OK;
  char what[64];
  snprintf(what, sizeof what, "must equal %s: a wheel is symmetric", SYMBOLS[xx]);
  return refuse(r, zz, BIKE_ERROR_PARAMETER, what);
}

static int check_complete(const reading *r) {
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; ++i) {
    if (r->symbols->line[i]) continue;
    return bike_message(r->error, BIKE_ERROR_SYNTAX, "%s: key '%s' is missing", r->path,
                        SYMBOLS[i]);
  }
  return BIKE_OK;
}

// Of a bicycle whose z points up, both frames are below the ground. Wheels are at their hubs.
static int check_plausible(const reading *r, const bike_bicycle *bicycle) {
  bike_doubt doubt;
  char what[256];
  if (!bike_has_doubt(&doubt, bicycle)) return BIKE_OK;
  const bool rear = doubt.part == 0;
  if (!doubt.below_ground)
    return refuse(r,
                  doubt.part < 0 ? MEIJAARD_W
                  : rear         ? MEIJAARD_XB
                                 : MEIJAARD_XH,
                  BIKE_ERROR_PARAMETER, doubt.text);
  snprintf(what, sizeof what, "must not be positive: z points down in this format, and %s",
           doubt.text);
  return refuse(r, rear ? MEIJAARD_ZB : MEIJAARD_ZH, BIKE_ERROR_PARAMETER, what);
}

// The symbol to blame for a rule of bike_check, by part (B, R, H, F) or by the bicycle's geometry.
static int symbol_line(int part, const char *rule, const char **key, const void *user) {
  static const int inertia[4] = {MEIJAARD_IBXX, MEIJAARD_IRXX, MEIJAARD_IHXX, MEIJAARD_IFXX};
  (void)rule;
  const bike_symbols *symbols = user;
  const int symbol = part >= 0 && part < 4 ? inertia[part] : MEIJAARD_W;
  *key = SYMBOLS[symbol];
  return symbols->line[symbol];
}

int bike_report_check(const bike_bicycle *bicycle, const char *path, bike_line_function *line_of,
                      const void *user, bike_file_error *error) {
  int part = -1;
  const char *rule = NULL, *key = NULL;
  const int code = bike_check(bicycle, &part, &rule);
  if (!code) return BIKE_OK;
  if (!rule) rule = bike_error_string(code);
  const int line = line_of(part, rule, &key, user);
  char what[BIKE_MESSAGE_SIZE];
  if (part >= 0)
    snprintf(what, sizeof what, "part '%s': %s", bicycle->parts[part].name, rule);
  else
    snprintf(what, sizeof what, "%s", rule);
  return bike_message_at(error, code, path, line, key, what);
}

int bike_symbols_to_file(bike_file *out, const bike_symbols *symbols, const char *path,
                         bike_file_error *error) {
  const reading r = {symbols, path, error};
  int code = check_complete(&r);
  if (!code) code = check_range(&r);
  if (!code) code = check_wheel(&r, MEIJAARD_IRZZ, MEIJAARD_IRXX);
  if (!code) code = check_wheel(&r, MEIJAARD_IFZZ, MEIJAARD_IFXX);
  bike_bicycle *bicycle = &out->bicycle;
  if (!code) code = bike_from_meijaard(bicycle, symbols->value);
  if (code) return code;
  bicycle->steer_damping = symbols->steer_damping;
  bicycle->parts[0].position[1] = -symbols->value[MEIJAARD_YB];
  bicycle->parts[2].position[1] = -symbols->value[MEIJAARD_YH];
  code = bike_report_check(bicycle, path, symbol_line, symbols, error);
  if (code) return code;
  code = check_plausible(&r, bicycle);
  if (code) return code;
  bike_doubt doubt;
  if (symbols->rider.given &&
      (!split_rider(bicycle, &symbols->rider) || bike_has_doubt(&doubt, bicycle)))
    return bike_message_at(error, BIKE_ERROR_PARAMETER, path, symbols->rider.line, "rider_share",
                           "this rider does not fit into the mass and inertia of B");
  out->has_meijaard = true;
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; ++i) {
    out->meijaard.value[i] = symbols->value[i];
    out->meijaard.sigma[i] = symbols->sigma[i];
    out->has_uncertainty = out->has_uncertainty || symbols->sigma[i] > 0;
  }
  return BIKE_OK;
}
