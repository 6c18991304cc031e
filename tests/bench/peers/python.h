// SPDX-License-Identifier: Apache-2.0
// The child process scipy_peer.py, started when it is first asked for something.
#ifndef BICYCLE_BENCH_PYTHON_H
#define BICYCLE_BENCH_PYTHON_H

#include "../notes.h"

#include <jansson.h>

typedef struct python_peer python_peer;

// NULL when out of memory. Closing ends the child and waits for it.
python_peer *python_open(void);
void python_close(python_peer *peer);

// Sends a request, which it takes over, and waits for the answer; free that with json_decref. NULL
// with a reason in the notes (may be NULL) where there is no Python, no scipy, or no answer.
json_t *python_ask(python_peer *peer, json_t *request, bench_notes *notes);

// The member `seconds` of the answer; NaN where there is none.
double python_seconds(python_peer *peer, json_t *request);

#endif
