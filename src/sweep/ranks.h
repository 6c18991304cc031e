// SPDX-License-Identifier: Apache-2.0
// Many processes, one sweep: rank 0 hands points out and writes the log, the others compute. With
// one rank, without mpirun, or built without MPI, nothing of MPI runs.
#ifndef SWEEP_RANKS_H
#define SWEEP_RANKS_H

#include "terminal/exit_code.h"
#include "work.h"

typedef struct sweep_ranks {
  int rank, count; // 0 and 1 where there is only this process
} sweep_ranks;

// Joins the other ranks, if a launcher started some. End it with sweep_ranks_end before exiting.
sweep_ranks sweep_ranks_begin(void);
void sweep_ranks_end(sweep_ranks ranks);

// The worst exit code of all ranks; `speaks` tells whether this rank is the one to say what it is:
// rank 0, or others where rank 0 is content. All ranks call it.
term_exit sweep_ranks_agree(sweep_ranks ranks, term_exit mine, bool *speaks);

// Whether every rank has the text that rank 0 has; of `size` bytes everywhere.
bool sweep_ranks_same(sweep_ranks ranks, const char *text, size_t size);

// Rank 0: hands out until all others have gone.
void sweep_ranks_serve(sweep_ranks ranks, sweep_job *job);

// The others: rank 0's desk, and leaving it.
sweep_desk sweep_ranks_desk(void);
void sweep_ranks_leave(void);

#endif
