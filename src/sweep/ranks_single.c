// SPDX-License-Identifier: Apache-2.0
// Built without MPI: this process is all there is.
#include "ranks.h"

sweep_ranks sweep_ranks_begin(void) {
  return (sweep_ranks){0, 1};
}

void sweep_ranks_end(sweep_ranks ranks) {
  (void)ranks;
}

term_exit sweep_ranks_agree(sweep_ranks ranks, term_exit mine, bool *speaks) {
  (void)ranks;
  *speaks = true;
  return mine;
}

bool sweep_ranks_same(sweep_ranks ranks, const char *text, size_t size) {
  (void)ranks, (void)text, (void)size;
  return true;
}

void sweep_ranks_serve(sweep_ranks ranks, sweep_job *job) {
  (void)ranks, (void)job;
}

static bool no_points(sweep_range *out, double rate, void *user) {
  (void)out, (void)rate, (void)user;
  return false;
}

static void keep_nothing(const sweep_batch *batch, void *user) {
  (void)batch, (void)user;
}

sweep_desk sweep_ranks_desk(void) {
  return (sweep_desk){no_points, keep_nothing, NULL};
}

void sweep_ranks_leave(void) {}
