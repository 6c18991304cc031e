// SPDX-License-Identifier: Apache-2.0
#include "report_pack.h"

#include "report_markup.h"
#include "report_series.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
  // Rows of all scenarios together. A row costs 45 (smooth rides) to 70 bytes of the page, so that
  // traces take up to 1.4 MB of the 3 MB that a page may have; twenty rides of 10 s at 10 ms fit
  // whole.
  ROW_BUDGET = 20000,
  LINEAR_BITS = 24,
  LINEAR_NONE = (1 << LINEAR_BITS) - 1,
  LINEAR_TOP = LINEAR_NONE - 1,
  LOG_NONE = 32767,
  LOG_SIGN = 32768
};

// Sizes from 1e-24, far below the rounding of anything shown, to 1e12.
static const double log_low = -24, log_high = 12;

// Signals of the reference, as far as it has them; the candidate follows from their residuals. What
// can be computed from others (normal forces, friction) is left to the page; slip and height belong
// to a side.
static bool is_packed(const trace_signal *signal) {
  return !trace_is_contact(signal) && !strstr(signal->name, "_normal") &&
         !strstr(signal->name, "_friction") && strcmp(signal->name, "work") != 0;
}

// Bytes in the making, and the list of columns that goes with them.
typedef struct pack {
  unsigned char *bytes;
  size_t size, room;
  size_t rows, stride;
  json_t *columns;
  bool lost;
} pack;

// Rows that both rides together take.
static size_t count_rows(const comparison *c) {
  size_t a = c->side[REFERENCE].trace.count, b = c->side[CANDIDATE].trace.count;
  return a > b ? a : b;
}

size_t report_pack_stride(const report *r) {
  size_t rows = 0;
  for (size_t i = 0; i < r->count; i++) rows += count_rows(&r->comparisons[i]);
  return rows / ROW_BUDGET + 1;
}

// Room for `planes` bytes of each row; NULL when out of memory.
static unsigned char *grow(pack *p, size_t planes) {
  size_t needed = p->size + planes * p->rows;
  if (needed > p->room) {
    size_t room = 2 * needed;
    unsigned char *bytes = realloc(p->bytes, room);
    if (!bytes) {
      p->lost = true;
      return NULL;
    }
    p->bytes = bytes;
    p->room = room;
  }
  unsigned char *start = p->bytes + p->size;
  p->size = needed;
  return start;
}

static void list(pack *p, const char *name, const char *unit, const char *side, const char *coding,
                 double low, double scale) {
  json_array_append_new(p->columns,
                        json_pack("{s:s, s:s, s:s, s:s, s:f, s:f}", "name", name, "unit", unit,
                                  "side", side, "coding", coding, "low", low, "scale", scale));
}

static uint32_t linear_code(double value, double low, double scale) {
  if (!isfinite(value)) return LINEAR_NONE;
  double code = scale > 0 ? rint((value - low) / scale) : 0;
  return code > LINEAR_TOP ? LINEAR_TOP : (uint32_t)code;
}

static json_int_t kept(const pack *p, size_t rows) {
  return (json_int_t)((rows + p->stride - 1) / p->stride);
}

static void add_linear(pack *p, const report_series *s, const trace_signal *signal,
                       const size_t ends[2]) {
  double low = 0, high = 0;
  report_series_range(s, &low, &high);
  double scale = high / (LINEAR_TOP - 1) - low / (LINEAR_TOP - 1); // quotients do not overflow
  if (scale > 0) low = floor(low / scale) * scale;                 // so that zero is a step
  unsigned char *out = grow(p, 3);
  uint32_t before = 0, slope = 0;
  for (size_t k = 0; out && k < p->rows; k++) {
    size_t row = k * p->stride;
    uint32_t code = linear_code(row < s->count ? s->value[row] : NAN, low, scale);
    uint32_t bend = (code - before - slope) & LINEAR_NONE; // modulo 2^24
    uint32_t zigzag = (bend << 1 ^ (bend >> (LINEAR_BITS - 1) ? LINEAR_NONE : 0)) & LINEAR_NONE;
    slope = code - before;
    before = code;
    for (size_t plane = 0; plane < 3; plane++) out[plane * p->rows + k] = zigzag >> 8 * plane & 255;
  }
  list(p, signal->name, signal->unit, "signal", "linear", low, scale);
  json_object_set_new(json_array_get(p->columns, json_array_size(p->columns) - 1), "ends",
                      json_pack("[I, I]", kept(p, ends[0]), kept(p, ends[1])));
}

static uint32_t log_code(double value) {
  if (!isfinite(value)) return LOG_NONE;
  if (value == 0) return 0;
  double share = (log10(fabs(value)) - log_low) / (log_high - log_low);
  double code = rint(fmin(1, fmax(0, share)) * (LOG_NONE - 2)) + 1;
  return (uint32_t)code | (value < 0 ? LOG_SIGN : 0);
}

// The value of largest size among a kept row and those left out after it; NaN if any is.
static double largest(const report_series *s, size_t begin, size_t stride) {
  if (begin >= s->count) return NAN;
  double worst = 0;
  for (size_t k = begin; k < begin + stride && k < s->count; k++) {
    if (isnan(s->value[k])) return NAN;
    if (fabs(s->value[k]) > fabs(worst)) worst = s->value[k];
  }
  return worst;
}

static void add_log(pack *p, const report_series *s, const char *name, const char *unit,
                    const char *side) {
  unsigned char *out = grow(p, 2);
  for (size_t k = 0; out && k < p->rows; k++) {
    uint32_t code = log_code(largest(s, k * p->stride, p->stride));
    out[k] = code & 255;
    out[p->rows + k] = code >> 8 & 255;
  }
  list(p, name, unit, side, "log", log_low, (log_high - log_low) / (LOG_NONE - 2));
}

static void add_signals(pack *p, const comparison *c) {
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++) {
    const trace_signal *signal = &trace_signals[i];
    size_t ends[2];
    if (!is_packed(signal)) continue;
    report_series value = report_series_either(c, signal, ends);
    report_series residual = report_series_residual(c, signal);
    p->lost |= !value.value || !residual.value;
    add_linear(p, &value, signal, ends);
    add_log(p, &residual, signal->name, signal->unit, "residual");
    report_series_clear(&value);
    report_series_clear(&residual);
  }
}

static void add_side(pack *p, const comparison *c, int side) {
  const char *label = c->side[side].label;
  report_series balance = report_series_balance(c, side);
  p->lost |= !balance.value;
  add_log(p, &balance, "balance", "", label);
  report_series_clear(&balance);
  for (int i = 0; c->side[side].trace.has_contacts && i < TRACE_SIGNAL_COUNT; i++) {
    const trace_signal *signal = &trace_signals[i];
    if (!trace_is_contact(signal) || !trace_has(&c->side[side].trace, signal)) continue;
    report_series value = report_series_of(c, side, signal);
    p->lost |= !value.value;
    add_log(p, &value, signal->name, signal->unit, label);
    report_series_clear(&value);
  }
}

static json_t *vector_json(const double v[3]) {
  return json_pack("[f, f, f]", v[0], v[1], v[2]);
}

// The rider's place, or without one the rear frame's centre of mass: what the replay marks.
static bool weight_place(double out[3], const bike_bicycle *b) {
  double mass = 0, moment[3] = {0};
  bool rider = false;
  for (int i = 0; i < b->part_count; i++) rider |= b->parts[i].rider;
  for (int i = 0; i < b->part_count; i++) {
    const bike_part *part = &b->parts[i];
    if (rider ? !part->rider : part->assembly != BIKE_REAR_FRAME) continue;
    mass += part->mass;
    for (int k = 0; k < 3; k++) moment[k] += part->mass * part->position[k];
  }
  for (int k = 0; mass > 0 && k < 3; k++) out[k] = moment[k] / mass;
  return rider;
}

// Of a wheel that rolls alone nobody knows a pitch.
static bool is_wheel(const comparison *c) {
  const trace_signal *pitch = trace_find_signal("pitch");
  return !trace_has(&c->side[REFERENCE].trace, pitch) &&
         !trace_has(&c->side[CANDIDATE].trace, pitch);
}

static double wheel_weight(const bike_bicycle *b) {
  double mass = 0;
  for (int i = 0; i < b->part_count; i++)
    if (b->parts[i].assembly == BIKE_REAR_WHEEL) mass += b->parts[i].mass;
  return mass * b->gravity;
}

// Lengths of the upright bicycle for the replay: (forward of the rear contact, left, up).
static json_t *geometry_json(const comparison *c) {
  const bike_bicycle *b = &c->scenario->bicycle;
  bike_upright upright;
  double weight[3] = {0};
  if (bike_upright_position(&upright, &b->geometry) != 0) return json_null();
  bool rider = weight_place(weight, b), wheel = is_wheel(c);
  return json_pack("{s:b, s:f, s:f, s:f, s:f, s:f, s:o, s:o, s:o, s:b, s:f}", "wheel_only", wheel,
                   "tilt", upright.tilt, "wheelbase", upright.wheelbase, "trail", upright.trail,
                   "rear_radius", b->geometry.R_r, "front_radius", b->geometry.R_f, "rear_hub",
                   vector_json(upright.rear_hub), "front_hub", vector_json(upright.front_hub),
                   "weight", vector_json(weight), "rider", rider, "total_weight",
                   wheel ? wheel_weight(b) : c->weight);
}

// Base64 of the zlib stream of some bytes.
static bool write_deflated(FILE *stream, const unsigned char *bytes, size_t size) {
  uLongf room = compressBound((uLong)size);
  unsigned char *out = malloc(room);
  bool done = out && compress2(out, &room, bytes, (uLong)size, Z_BEST_COMPRESSION) == Z_OK;
  if (done) report_base64(stream, out, room);
  free(out);
  return done;
}

bool report_pack_text(FILE *stream, const char *text) {
  return write_deflated(stream, (const unsigned char *)text, strlen(text));
}

static bool write_object(FILE *stream, const pack *p, const comparison *c) {
  json_t *head = json_pack("{s:I, s:f, s:I, s:o, s:O}", "rows", (json_int_t)p->rows, "step",
                           c->scenario->sample * (double)p->stride, "stride", (json_int_t)p->stride,
                           "geometry", geometry_json(c), "columns", p->columns);
  char *text = head ? json_dumps(head, JSON_COMPACT) : NULL;
  json_decref(head);
  if (!text) return false;
  fprintf(stream, "%.*s,\"bytes\":\"", (int)strlen(text) - 1, text); // without its last brace
  free(text);
  bool done = write_deflated(stream, p->bytes, p->size);
  fputs("\"}", stream);
  return done;
}

bool report_pack(FILE *stream, const comparison *c, size_t stride) {
  size_t count = count_rows(c);
  pack p = {.rows = (count + stride - 1) / stride, .stride = stride, .columns = json_array()};
  add_signals(&p, c);
  for (int i = 0; i < 2; i++) add_side(&p, c, i);
  bool done = !p.lost && p.columns && write_object(stream, &p, c);
  json_decref(p.columns);
  free(p.bytes);
  return done;
}
