// SPDX-License-Identifier: Apache-2.0
// What no ground and no rider can do: a wheel pulled down, more friction than a coefficient allows,
// a rider farther to the side than he can get. The equations answer all the same; programs say so.
#ifndef BICYCLE_TERMINAL_OUTSIDE_H
#define BICYCLE_TERMINAL_OUTSIDE_H

#include "terminal/json.h"

#include <argp.h>
#include <bicycle/bicycle.h>
#include <bicycle/ground.h>

typedef struct term_limits {
  double friction; //    coefficient of friction, > 0
  double reach;    // m  how far the rider can move to either side; 0: as far as he likes
} term_limits;

// --friction and --reach: a child parser whose input is a term_limits. Sets the defaults, friction
// 1 and reach 0, before it parses; then term_set_reach.
extern const struct argp term_limits_argp;

// A reach that was not given becomes a fifth of the height of the rider's centre of mass above the
// ground; src/README.md says why. Without a rider it stays 0.
void term_set_reach(term_limits *limits, const bike_bicycle *bicycle);

typedef enum term_outside_kind { TERM_PULLED, TERM_FRICTION, TERM_RIDER } term_outside_kind;

typedef struct term_outside_item {
  term_outside_kind kind;
  const char *wheel;         //    "rear" or "front"; NULL: the rider
  bool disc;                 //    `wheel` is the name of a disc of any model
  double value, limit;       //    force with which the ground pulls, N; friction; offset, m
  double time;               // s  of a ride: when the value was largest
  const bike_spells *spells; //    of a ride: when it was outside; NULL: an instant, or the rider
} term_outside_item;

enum { TERM_MOST_OUTSIDE = 5 };

// Zero it before adding.
typedef struct term_outside {
  int count;
  term_outside_item items[TERM_MOST_OUTSIDE];
} term_outside;

// One wheel at one instant. A wheel that is pulled asks no friction.
void term_outside_wheel(term_outside *out, const char *wheel, double normal, double friction,
                        const term_limits *limits);
void term_outside_rider(term_outside *out, double offset, const term_limits *limits);

// One wheel over a ride; `ground` must stay valid.
void term_outside_ride(term_outside *out, const char *wheel, bool disc,
                       const bike_wheel_ground *ground, const term_limits *limits);

// A friction in words: "0.31", "without bound".
void term_friction_text(char out[32], double friction);

// One item in words: "the rear wheel is pulled with 6396 N". A few: "rear pulled 6396 N".
enum { TERM_OUTSIDE_SIZE = 192 };
void term_outside_text(char out[TERM_OUTSIDE_SIZE], const term_outside_item *item);
void term_outside_brief(char out[TERM_OUTSIDE_SIZE], const term_outside *outside);

// [{wheel (not of the rider; disc in any other model), kind: "pulled", "friction" or "rider",
// value, limit, and of a ride time, first, duration}]; a friction without bound is null.
json_t *term_outside_json(const term_outside *outside);

#endif
