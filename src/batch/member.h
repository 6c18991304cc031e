// SPDX-License-Identifier: Apache-2.0
// One member of an ensemble, ridden alone by bike_ride: the plain path, and the end of rides that
// the lanes hand over.
#ifndef BICYCLE_BATCH_MEMBER_H
#define BICYCLE_BATCH_MEMBER_H

#include <bicycle/ensemble.h>

// Straight riding is looked for this often, and must have been seen so many times in a row: from
// the first look to the last a second, which cannot be a passage of an oscillation.
static const double MEMBER_LOOK = 0.05; // s
enum { MEMBER_LOOKS_SETTLED = 21 };

// Whether it rides straight, or its circle, at the moment; and whether having done so for all of
// these looks settles it.
bool member_is_quiet(const bike_member *member, const bike_state *state, double settled);
bool member_has_settled(const bike_member *member, const bike_state *state,
                        const bike_ensemble_def *def);

// Rides from a state at a time on; `out` has what was before (lifted, steps, evaluations).
void member_ride_on(bike_member_result *out, const bike_member *member, double time,
                    const bike_state *state, const bike_ensemble_def *def);

#endif
