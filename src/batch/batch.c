// SPDX-License-Identifier: Apache-2.0
#include <bicycle/batch.h>

#include <bicycle/error.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "batch/lanes.h"
#include "equations/instruction_set.h"

struct bike_batch {
  const lanes_functions *lanes;
  size_t model_count;
  bike_model *models; // for what the lanes cannot solve
  char *blocks;       // lanes_models, one after the other
};

int bike_batch_width(void) {
  return lanes_in_use()->width;
}

const char *bike_instructions(void) {
  return instruction_set_string(instruction_set_in_use());
}

static lanes_models *block_at(const bike_batch *b, size_t i) {
  return (lanes_models *)(b->blocks + i * b->lanes->block_size);
}

// The last block's spare lanes hold the last bicycle once more.
static void pack_all(bike_batch *b) {
  size_t width = (size_t)b->lanes->width, last = b->model_count - 1;
  for (size_t k = 0; k * width <= last; k++)
    for (size_t i = 0; i < width; i++) {
      size_t which = k * width + i < last ? k * width + i : last;
      b->lanes->pack(block_at(b, k), &b->models[which], (int)i);
    }
}

// Of the widest vectors; aligned_alloc takes nothing but multiples of it.
enum { ALIGNMENT = 64 };

static size_t rounded_up(size_t size) {
  return (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

int bike_batch_create(bike_batch **out, const bike_model *models, size_t model_count) {
  if (!out || !models || model_count == 0) return BIKE_ERROR_ARGUMENT;
  bike_batch *b = calloc(1, sizeof *b);
  if (!b) return BIKE_ERROR_MEMORY;
  b->lanes = lanes_in_use();
  b->model_count = model_count;
  size_t width = (size_t)b->lanes->width;
  size_t blocks = (model_count - 1) / width + 1;
  b->models = calloc(model_count, sizeof *models);
  if (blocks < SIZE_MAX / b->lanes->block_size)
    b->blocks = aligned_alloc(ALIGNMENT, rounded_up(blocks * b->lanes->block_size));
  if (!b->models || !b->blocks) {
    bike_batch_free(b);
    return BIKE_ERROR_MEMORY;
  }
  memcpy(b->models, models, model_count * sizeof *models);
  pack_all(b);
  *out = b;
  return BIKE_OK;
}

void bike_batch_free(bike_batch *b) {
  if (!b) return;
  free(b->models);
  free(b->blocks);
  free(b);
}

static void put(bike_batch_accelerations *out, size_t i, int code, const bike_acceleration *a) {
  out->lean[i] = code ? NAN : a->lean;
  out->steer[i] = code ? NAN : a->steer;
  out->speed[i] = code ? NAN : a->speed;
  if (out->codes) out->codes[i] = code;
}

// What a lane has not solved, the scalar path does, or says why not.
static void solve_alone(bike_batch_accelerations *out, const bike_batch *b,
                        const bike_batch_states *s, size_t i) {
  const bike_model *model = &b->models[b->model_count == 1 ? 0 : i];
  bike_state state = {.lean = s->lean[i],
                      .steer = s->steer[i],
                      .lean_rate = s->lean_rate[i],
                      .steer_rate = s->steer_rate[i],
                      .speed = s->speed[i]};
  bike_acceleration a;
  int code = bike_accelerate(&a, model, &state, NULL);
  put(out, i, code, &a);
}

typedef struct block_view {
  const double *state[LANES_STATE];
  double *out[LANES_ACCELERATIONS];
} block_view;

static block_view view_of(const bike_batch_accelerations *out, const bike_batch_states *s,
                          size_t first) {
  return (block_view){.state = {[LANES_LEAN] = s->lean + first,
                                [LANES_STEER] = s->steer + first,
                                [LANES_LEAN_RATE] = s->lean_rate + first,
                                [LANES_STEER_RATE] = s->steer_rate + first,
                                [LANES_SPEED] = s->speed + first},
                      .out = {[LANES_LEAN_ACC] = out->lean + first,
                              [LANES_STEER_ACC] = out->steer + first,
                              [LANES_SPEED_RATE] = out->speed + first}};
}

// Fewer states than lanes: spare lanes hold the first of them.
static uint64_t solve_part(const bike_batch *b, const lanes_models *block, const block_view *view,
                           size_t used) {
  double state[LANES_STATE][LANES_MOST], out[LANES_ACCELERATIONS][LANES_MOST];
  block_view padded;
  for (int k = 0; k < LANES_STATE; k++) {
    for (int i = 0; i < LANES_MOST; i++) state[k][i] = view->state[k][(size_t)i < used ? i : 0];
    padded.state[k] = state[k];
  }
  for (int k = 0; k < LANES_ACCELERATIONS; k++) padded.out[k] = out[k];
  uint64_t solved = b->lanes->accelerate(padded.out, block, true, padded.state, 1);
  for (int k = 0; k < LANES_ACCELERATIONS; k++) memcpy(view->out[k], out[k], used * sizeof(double));
  return solved;
}

// States first .. first + used, of whole blocks or less than one.
static void solve_some(bike_batch_accelerations *out, const bike_batch *b,
                       const bike_batch_states *s, size_t first, size_t used) {
  size_t width = (size_t)b->lanes->width, blocks = used / width;
  bool same = b->model_count == 1;
  const lanes_models *models = block_at(b, same ? 0 : first / width);
  block_view view = view_of(out, s, first);
  uint64_t solved = blocks > 0
                        ? b->lanes->accelerate(view.out, models, same, view.state, (int)blocks)
                        : solve_part(b, models, &view, used);
  if (out->codes) memset(out->codes + first, 0, used * sizeof *out->codes); // BIKE_OK
  uint64_t all = UINT64_MAX >> (64 - used);
  for (size_t i = 0; (solved & all) != all && i < used; i++)
    if (!(solved >> i & 1)) solve_alone(out, b, s, first + i);
}

static bool complete(const bike_batch_accelerations *out, const bike_batch_states *s) {
  return s->lean && s->steer && s->lean_rate && s->steer_rate && s->speed && out->lean &&
         out->steer && out->speed;
}

int bike_batch_accelerate(bike_batch_accelerations *out, const bike_batch *batch,
                          const bike_batch_states *states, size_t count) {
  if (!out || !batch || !states) return BIKE_ERROR_ARGUMENT;
  if (count > 0 && !complete(out, states)) return BIKE_ERROR_ARGUMENT;
  if (batch->model_count != 1 && count != batch->model_count) return BIKE_ERROR_ARGUMENT;
  size_t width = (size_t)batch->lanes->width, most = LANES_BLOCKS * width, used;
  for (size_t first = 0; first < count; first += used) {
    size_t left = count - first;
    used = left < width ? left : left < most ? left / width * width : most;
    solve_some(out, batch, states, first, used);
  }
  return BIKE_OK;
}
