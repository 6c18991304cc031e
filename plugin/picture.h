// SPDX-License-Identifier: Apache-2.0
// A picture of any MuJoCo model, rendered without a display: MuJoCo's own renderer on OSMesa, which
// is looked for when the first picture is made, so that no other program loads a GL.
// One thread at a time: a GL context belongs to the thread that made it.
#ifndef PICTURE_H
#define PICTURE_H

#include "bicycle_mjcf.h"

#include <stdio.h>

enum { PICTURE_LEAST_SIZE = 16, PICTURE_MOST_SIZE = 4096 }; // pixels

typedef struct picture_size {
  int width, height; // pixels, each in the range above
} picture_size;

// 0 or why there is no picture; details stand in mjcf_error.
typedef enum picture_status {
  PICTURE_OK,
  PICTURE_ARGUMENT, // a size out of range, a camera that the model does not have
  PICTURE_MEMORY,   //
  PICTURE_NO_GL,    // no OSMesa on this machine, or it does not work
} picture_status;

typedef struct picture picture;

// Prepares pictures of a model, which is copied. `camera` is the name of one of its cameras; NULL
// shows all that moves, from the right and before it. NULL with a text in `error`, and why in
// `status`. Free with picture_free; NULL is allowed there.
picture *picture_create(const mjModel *model, picture_size size, const char *camera,
                        picture_status *status, mjcf_error *error);
void picture_free(picture *p);

// Renders the model at `qpos` (nq numbers) as a PNG onto the stream, whose own errors stay in it.
// Errors: PICTURE_NO_GL, PICTURE_MEMORY.
picture_status picture_write(FILE *out, picture *p, const mjtNum *qpos, mjcf_error *error);

#endif
