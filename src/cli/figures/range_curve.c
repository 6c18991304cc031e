// SPDX-License-Identifier: Apache-2.0
#include "range_curve.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct question {
  const bike_bicycle *bicycle;
  bike_variation variation;
  bike_front_hold hold;
  double fastest;
} question;

static range_sample sample_at(const question *q, double value) {
  range_sample sample = {.value = value, .count = -1};
  bike_bicycle changed;
  bike_model model;
  bike_critical_speeds found;
  if (bike_vary(&changed, q->bicycle, q->variation, value, q->hold) ||
      bike_model_init(&model, &changed) ||
      bike_upright_critical_speeds(&found, &model, 0, q->fastest))
    return sample;
  sample.count = found.range_count;
  memcpy(sample.ranges, found.ranges, sizeof sample.ranges);
  return sample;
}

// Narrows the change between two samples down to a small part of their distance.
static void close_in(range_sample *a, range_sample *b, const question *q) {
  enum { HALVINGS = 20 }; // a millionth
  for (int i = 0; i < HALVINGS; i++) {
    range_sample middle = sample_at(q, 0.5 * (a->value + b->value));
    if (middle.count == a->count)
      *a = middle;
    else
      *b = middle;
  }
}

static bool append(range_curve *out, const range_sample *sample, int *room) {
  if (out->count == *room) {
    int more = *room ? 2 * *room : 256;
    range_sample *grown = realloc(out->samples, (size_t)more * sizeof *grown);
    if (!grown) return false;
    out->samples = grown;
    *room = more;
  }
  out->samples[out->count++] = *sample;
  return true;
}

// Whether a limit moves so far between two samples that a chord would show as one.
static bool is_steep(const range_sample *a, const range_sample *b, double fastest) {
  const double far = fastest / 160; // a fortieth of the picture, which shows a quarter of it
  for (int i = 0; i < a->count; i++)
    for (int end = 0; end < 2; end++)
      if (fabs(b->ranges[i][end] - a->ranges[i][end]) > far) return true;
  return false;
}

// Appends what is needed between the last sample and `next`, and that one.
static bool join(range_curve *out, const range_sample *next, const question *q, int *room,
                 int halvings) {
  range_sample before = out->samples[out->count - 1], after = *next;
  if (before.count != after.count) {
    close_in(&before, &after, q);
    return append(out, &before, room) && append(out, &after, room) && append(out, next, room);
  }
  if (halvings > 0 && is_steep(&before, next, q->fastest)) {
    range_sample middle = sample_at(q, 0.5 * (before.value + next->value));
    return join(out, &middle, q, room, halvings - 1) && join(out, next, q, room, halvings - 1);
  }
  return append(out, next, room);
}

int range_curve_make(range_curve *out, const bike_bicycle *bicycle, bike_variation variation,
                     bike_front_hold hold, const term_range *values, double fastest) {
  enum { HALVINGS = 5 }; // of a two-hundredth of the axis: a tenth of a pixel
  double now;
  int room = 0;
  question q = {bicycle, variation, hold, fastest};
  *out = (range_curve){0};
  int code = bike_variation_value(&now, bicycle, variation);
  if (code) return code;
  for (long i = 0; i < values->count; i++) {
    range_sample next = sample_at(&q, term_range_point(values, i));
    if (!(i > 0 ? join(out, &next, &q, &room, HALVINGS) : append(out, &next, &room)))
      return BIKE_ERROR_MEMORY;
  }
  return BIKE_OK;
}

void range_curve_free(range_curve *curve) {
  free(curve->samples);
}
