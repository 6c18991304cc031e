// SPDX-License-Identifier: Apache-2.0
// Playing a suite on several threads, to the same result as on one.
//
// A scenario shares nothing with another but what is process-global in MuJoCo: its compiler, for
// which threads wait (plugin/bicycle_mjcf.h), and its callbacks and handlers, which the first
// runner sets for all (plugin/runner.h); they find the ride they serve by thread, model and mjData.
// What would disturb others, or be disturbed, is played when all else is done: see is_alone.
#include "suite.h"

#include "terminal/progress.h"

#include <pthread.h>
#include <stdlib.h>

typedef struct player {
  suite *suite;
  pthread_mutex_t lock; // of all that follows; a problem belongs to the thread of its scenario
  size_t next;          // the first scenario that nobody has taken
  size_t stop;          // the first one with a problem, or the number of scenarios
  problem *problems;    // one for each scenario
  term_exit *codes;     //
  double *shares;       // done, 0..1
  term_progress progress;
} player;

// Who tells of progress.
typedef struct teller {
  player *player;
  size_t index;
} teller;

// Timings mean nothing beside a busy thread; an engine may say that it needs the process.
static bool is_alone(const scenario *s) {
  return s->cost.repeats > 0 || s->reference.engine->alone || s->candidate.engine->alone;
}

// The bar is that of all scenarios, which count alike; it names the first that is not done.
static void show(player *p) {
  double sum = 0;
  size_t first = p->suite->count;
  for (size_t i = p->suite->count; i-- > 0;) {
    sum += p->shares[i];
    if (p->shares[i] < 1) first = i;
  }
  if (first < p->suite->count)
    term_progress_show(&p->progress, p->suite->scenarios[first].name,
                       sum / (double)p->suite->count);
}

static void tell(double share, void *user) {
  const teller *t = user;
  pthread_mutex_lock(&t->player->lock);
  t->player->shares[t->index] = share;
  show(t->player);
  pthread_mutex_unlock(&t->player->lock);
}

static void play(player *p, size_t index) {
  comparison *c = &p->suite->comparisons[index];
  const scenario *s = &p->suite->scenarios[index];
  problem *said = &p->problems[index];
  teller t = {p, index};
  tell(0, &t);
  term_exit code = comparison_open(c, s, said);
  if (code != TERM_DONE) problem_prefix(said, code, s->name);
  c->progress = tell;
  c->user = &t;
  if (code == TERM_DONE) code = comparison_run(c, said);
  c->progress = NULL;
  tell(1, &t);
  pthread_mutex_lock(&p->lock);
  p->codes[index] = code;
  if (code != TERM_DONE && index < p->stop) p->stop = index;
  pthread_mutex_unlock(&p->lock);
}

// Takes the next scenario of that kind, in their order; false where there is none, or where one
// before it has a problem: that one would have been the last to be played on one thread.
static bool take(player *p, bool alone, size_t *index) {
  pthread_mutex_lock(&p->lock);
  while (p->next < p->stop && is_alone(&p->suite->scenarios[p->next]) != alone) p->next++;
  *index = p->next;
  bool taken = p->next < p->stop;
  p->next += taken;
  pthread_mutex_unlock(&p->lock);
  return taken;
}

static void *play_many(void *argument) {
  player *p = argument;
  size_t index;
  while (take(p, false, &index)) play(p, index);
  return NULL;
}

// This thread and `more` others. One that cannot be had is one less.
static void play_together(player *p, size_t more) {
  pthread_t *threads = calloc(more + 1, sizeof *threads);
  size_t begun = 0;
  while (threads && begun < more && pthread_create(&threads[begun], NULL, play_many, p) == 0)
    begun++;
  play_many(p);
  while (begun > 0) pthread_join(threads[--begun], NULL);
  free(threads);
}

static void play_alone(player *p) {
  size_t index;
  p->next = 0;
  while (take(p, true, &index)) play(p, index);
}

// On one thread scenarios are played in their order, whatever they need.
static void play_in_order(player *p) {
  while (p->next < p->stop) play(p, p->next++);
}

term_exit suite_play(suite *s, int jobs, problem *p) {
  player all = {.suite = s,
                .lock = PTHREAD_MUTEX_INITIALIZER,
                .stop = s->count,
                .problems = calloc(s->count + 1, sizeof *all.problems),
                .codes = calloc(s->count + 1, sizeof *all.codes),
                .shares = calloc(s->count + 1, sizeof *all.shares)};
  size_t threads = jobs < 1 ? 1 : (size_t)jobs < s->count ? (size_t)jobs : s->count;
  term_exit code = all.problems && all.codes && all.shares ? TERM_DONE : problem_memory(p);
  if (code == TERM_DONE && threads > 1) {
    play_together(&all, threads - 1);
    play_alone(&all);
  } else if (code == TERM_DONE) {
    play_in_order(&all);
  }
  term_progress_clear(&all.progress);
  if (code == TERM_DONE && all.stop < s->count) {
    code = all.codes[all.stop];
    *p = all.problems[all.stop];
  }
  free(all.problems);
  free(all.codes);
  free(all.shares);
  return code;
}
