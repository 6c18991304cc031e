// SPDX-License-Identifier: Apache-2.0
// States and accelerations of a batch as columns.
#ifndef BICYCLE_TESTS_BATCH_COLUMNS_H
#define BICYCLE_TESTS_BATCH_COLUMNS_H

#include <bicycle/batch.h>

enum { COLUMNS_MOST = 1024 };

// One number more than asked, so that columns can also start at an odd address of doubles.
typedef struct columns {
  double state[5][COLUMNS_MOST + 1];
  double out[3][COLUMNS_MOST + 1];
  int codes[COLUMNS_MOST];
} columns;

// Accelerates `count` states of as many models, or of one; columns start `offset` numbers late.
void columns_solve(columns *c, const bike_model *models, size_t model_count,
                   const bike_state *states, size_t count, size_t offset);

bike_acceleration columns_result(const columns *c, size_t i, size_t offset);

#endif
