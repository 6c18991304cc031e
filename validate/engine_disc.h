// SPDX-License-Identifier: Apache-2.0
// What the two engines of a disc share, which is how a scenario's words are meant: the disc is the
// rear wheel of the bicycle, all else of it away. Its lean is that of the wheel, its steer its yaw
// (a wheel alone steers itself), its speed that of the contact point along its track.
#ifndef VALIDATE_ENGINE_DISC_H
#define VALIDATE_ENGINE_DISC_H

#include "disc.h"
#include "engine.h"

// The rear wheel; TERM_USAGE where it is no disc: no mass, off its hub, or not round.
term_exit engine_disc_body(disc_body *out, const bike_bicycle *bicycle, problem *p);

// Disc and state: contact point in the origin, spin angle zero.
void engine_disc_start(double out[DISC_STATES], const disc_body *b, const bike_state *state);

// What nobody knows of a wheel without a bicycle: pitch and the front wheel.
uint64_t engine_disc_missing(void);

// When the lean passed the limit, between two leans at `time` - `step` and `time` (linear).
double engine_disc_fall(double time, double step, double before, double now, double limit);

#endif
