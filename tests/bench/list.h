// SPDX-License-Identifier: Apache-2.0
// The contests of a run, and what is compared in them: one bicycle in one state.
//
// A group of contests is one function in one file cases_GROUP.c, named in BENCH_GROUPS:
//   bench_add(list, &(bench_contest){.name = "rhs-what", .question = "theirs / ours",
//                                    .ours = {"bike_what", our_work, context},
//                                    .theirs = {"what", their_work, context}, .asked = 3});
// Contexts come from bench_new.
#ifndef BICYCLE_BENCH_LIST_H
#define BICYCLE_BENCH_LIST_H

#include "contest.h"
#include "peers/python.h"

#include <bicycle/state.h>
#include <stddef.h>

typedef struct bench_subject {
  bike_bicycle bicycle; //
  bike_model model;
  bike_state state;      // of a single evaluation: generic, nothing zero that matters
  bike_state ride_start; // of rides: roll, hands off
  double ride_time;      // s
  bool quick;
} bench_subject;

enum { BENCH_MAX_CONTESTS = 64 };

// What a group allocated.
typedef struct bench_owned {
  void *context;
  void (*end)(void *);
} bench_owned;

typedef struct bench_list {
  bench_subject *subject;
  python_peer *python; // not started before somebody asks it something
  bench_contest contests[BENCH_MAX_CONTESTS];
  int count;
  bench_owned owned[BENCH_MAX_CONTESTS];
  int owned_count;
} bench_list;

// False with one line on stderr. Groups only set up what costs nothing; the rest is for `prepare`.
typedef bool bench_group(bench_list *list);

bench_group bench_rhs_cases;      // cases_rhs.c: one right-hand side
bench_group bench_floor_cases;    // cases_floor.c: the machine's limit
bench_group bench_batch_cases;    // cases_batch.c: accelerations in lanes
bench_group bench_jacobian_cases; // cases_jacobian.c: Jacobians and eigenvalues in lanes
bench_group bench_map_cases;      // cases_map.c: points of maps
bench_group bench_ride_cases;     // cases_ride.c: rides of ten seconds
bench_group bench_ensemble_cases; // cases_ensemble.c: many rides
bench_group bench_mujoco_cases;   // cases_mujoco.c: what rolling costs MuJoCo

#define BENCH_GROUPS                                                                               \
  {                                                                                                \
    bench_rhs_cases, bench_floor_cases, bench_batch_cases, bench_jacobian_cases, bench_map_cases,  \
        bench_ride_cases, bench_ensemble_cases, bench_mujoco_cases                                 \
  }

// A list of all groups. False with one line on stderr; close it in any case.
bool bench_list_open(bench_list *out, bench_subject *subject);
void bench_list_close(bench_list *list);

void bench_add(bench_list *list, const bench_contest *contest);

// Several, whose `prepare` gets this context.
void bench_add_all(bench_list *list, const bench_contest *contests, size_t count, void *context);

// calloc for a group: freed with the list, after `end` (may be NULL) has seen it. Never NULL: out
// of memory a bench ends.
void *bench_new(bench_list *list, size_t size, void (*end)(void *));

#endif
