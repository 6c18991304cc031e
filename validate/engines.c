// SPDX-License-Identifier: Apache-2.0
#include "engine.h"

#include <string.h>
#include <time.h>

static const engine *const engines[] = {&engine_analytic, &engine_mujoco};

enum { ENGINE_COUNT = sizeof engines / sizeof engines[0] };

const engine *engine_at(int index) {
  return index >= 0 && index < ENGINE_COUNT ? engines[index] : NULL;
}

const engine *engine_find(const char *name) {
  for (int i = 0; i < ENGINE_COUNT; i++)
    if (strcmp(engines[i]->name, name) == 0) return engines[i];
  return NULL;
}

engine_choice engine_default_choice(const engine *e) {
  engine_choice choice = {.engine = e};
  for (int i = 0; i < e->option_count; i++) choice.option[i] = e->options[i].value;
  return choice;
}

double engine_clock(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
