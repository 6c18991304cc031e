// SPDX-License-Identifier: Apache-2.0
// Ranks with MPI. A worker sends records, then asks for more and waits for a range; an empty one
// says that there are no more. Messages of one rank arrive in the order in which it sent them.
#include "ranks.h"

#include <mpi.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { TAG_ASK = 1, TAG_RECORDS, TAG_LEAVE, TAG_RANGE };

// In front of the records of a batch.
typedef struct heading {
  int64_t first, count, failed;
} heading;

// OpenMPI and PMIx launchers (mpirun, srun --mpi=pmix) leave these. MPI_Init without one would
// start a helper process for nothing.
static bool is_launched(void) {
  const char *size = getenv("OMPI_COMM_WORLD_SIZE");
  return size ? strcmp(size, "1") != 0 : getenv("PMIX_RANK") != NULL;
}

sweep_ranks sweep_ranks_begin(void) {
  sweep_ranks ranks = {0, 1};
  int provided;
  if (!is_launched()) return ranks;
  // The threads of a worker take turns at the desk.
  MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &ranks.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks.count);
  return ranks;
}

void sweep_ranks_end(sweep_ranks ranks) {
  int running;
  (void)ranks;
  MPI_Initialized(&running);
  if (running) MPI_Finalize();
}

term_exit sweep_ranks_agree(sweep_ranks ranks, term_exit mine, bool *speaks) {
  int first = (int)mine, worst = (int)mine;
  *speaks = true;
  if (ranks.count == 1) return mine;
  MPI_Bcast(&first, 1, MPI_INT, 0, MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  *speaks = ranks.rank == 0 || first == TERM_DONE;
  return (term_exit)worst;
}

bool sweep_ranks_same(sweep_ranks ranks, const char *text, size_t size) {
  if (ranks.count == 1) return true;
  char *first = calloc(size, 1);
  if (!first) MPI_Abort(MPI_COMM_WORLD, TERM_INVALID);
  if (ranks.rank == 0) memcpy(first, text, size);
  MPI_Bcast(first, (int)size, MPI_CHAR, 0, MPI_COMM_WORLD);
  bool same = memcmp(first, text, size) == 0;
  free(first);
  return same;
}

// ---- rank 0 ----

static void receive_records(sweep_job *job, const MPI_Status *status) {
  int size;
  MPI_Get_count(status, MPI_CHAR, &size);
  char *message = malloc((size_t)size + 1);
  heading head;
  if (!message) MPI_Abort(MPI_COMM_WORLD, TERM_INVALID); // the log stays whole
  MPI_Recv(message, size, MPI_CHAR, status->MPI_SOURCE, TAG_RECORDS, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  memcpy(&head, message, sizeof head);
  sweep_job_deliver(job, &(sweep_batch){.range = {(long)head.first, (long)head.count},
                                        .failed = (long)head.failed,
                                        .text = message + sizeof head,
                                        .size = (size_t)size - sizeof head});
  free(message);
}

static void answer_asking(sweep_job *job, int worker) {
  double rate;
  sweep_range range = {0};
  MPI_Recv(&rate, 1, MPI_DOUBLE, worker, TAG_ASK, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  if (!sweep_job_next(job, &range, rate)) range.count = 0;
  const int64_t reply[2] = {range.first, range.count};
  MPI_Send(reply, 2, MPI_INT64_T, worker, TAG_RANGE, MPI_COMM_WORLD);
}

// Sleeps while nobody asks: MPI's own waiting would take a whole processor from the workers. Up to
// a thousandth of a second, little beside the quarter of a second of a share.
static void nap(int idle) {
  const long longest = 1000000, ns = idle < 20 ? 50000L * idle : longest;
  nanosleep(&(struct timespec){.tv_nsec = ns < longest ? ns : longest - 1}, NULL);
}

void sweep_ranks_serve(sweep_ranks ranks, sweep_job *job) {
  int idle = 0;
  for (int working = ranks.count - 1; working > 0;) {
    int found;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &status);
    if (!found) {
      nap(idle++);
      continue;
    }
    idle = 0;
    if (status.MPI_TAG == TAG_RECORDS) {
      receive_records(job, &status);
    } else if (status.MPI_TAG == TAG_ASK) {
      answer_asking(job, status.MPI_SOURCE);
    } else {
      MPI_Recv(NULL, 0, MPI_CHAR, status.MPI_SOURCE, TAG_LEAVE, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      working--;
    }
  }
}

// ---- the others ----

static bool ask(sweep_range *out, double rate, void *user) {
  (void)user;
  int64_t reply[2];
  MPI_Send(&rate, 1, MPI_DOUBLE, 0, TAG_ASK, MPI_COMM_WORLD);
  MPI_Recv(reply, 2, MPI_INT64_T, 0, TAG_RANGE, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  *out = (sweep_range){(long)reply[0], (long)reply[1]};
  return out->count > 0;
}

static void send_records(const sweep_batch *batch, void *user) {
  (void)user;
  const heading head = {batch->range.first, batch->range.count, batch->failed};
  char *message = malloc(sizeof head + batch->size);
  if (!message) MPI_Abort(MPI_COMM_WORLD, TERM_INVALID);
  memcpy(message, &head, sizeof head);
  memcpy(message + sizeof head, batch->text, batch->size);
  MPI_Send(message, (int)(sizeof head + batch->size), MPI_CHAR, 0, TAG_RECORDS, MPI_COMM_WORLD);
  free(message);
}

sweep_desk sweep_ranks_desk(void) {
  return (sweep_desk){ask, send_records, NULL};
}

void sweep_ranks_leave(void) {
  MPI_Send(NULL, 0, MPI_CHAR, 0, TAG_LEAVE, MPI_COMM_WORLD);
}
