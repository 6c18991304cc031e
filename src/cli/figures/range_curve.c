// SPDX-License-Identifier: Apache-2.0
#include "range_curve.h"

#include <bicycle/error.h>
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

int range_curve_make(range_curve *out, const bike_bicycle *bicycle, bike_variation variation,
                     bike_front_hold hold, const term_range *values, double fastest) {
  double now;
  question q = {bicycle, variation, hold, fastest};
  *out = (range_curve){0};
  int code = bike_variation_value(&now, bicycle, variation);
  if (code) return code;
  // every value brings at most itself and two more
  out->samples = calloc(3 * (size_t)values->count, sizeof *out->samples);
  if (!out->samples) return BIKE_ERROR_MEMORY;
  for (long i = 0; i < values->count; i++) {
    range_sample next = sample_at(&q, term_range_point(values, i));
    if (i > 0 && next.count != out->samples[out->count - 1].count) {
      range_sample before = out->samples[out->count - 1], after = next;
      close_in(&before, &after, &q);
      out->samples[out->count++] = before;
      out->samples[out->count++] = after;
    }
    out->samples[out->count++] = next;
  }
  return BIKE_OK;
}

void range_curve_free(range_curve *curve) {
  free(curve->samples);
}
