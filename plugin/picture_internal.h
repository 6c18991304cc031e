// SPDX-License-Identifier: Apache-2.0
// What the files of picture share; not for users.
#ifndef PICTURE_INTERNAL_H
#define PICTURE_INTERNAL_H

#include "picture.h"

#include <stdbool.h>

//---------------------------------- GL (picture_gl.c) ---------------------------------------------

typedef struct picture_gl picture_gl;

// A context of the size, current in this thread. NULL with a text.
picture_gl *picture_gl_create(picture_size size, mjcf_error *error);
void picture_gl_free(picture_gl *gl);

//---------------------------------- view (picture_view.c) -----------------------------------------

// Needs the kinematics of d. Places a free camera so that everything which moves is in the picture
// and little else: from the right, a third of the way to the front, and somewhat above.
void picture_frame(mjvCamera *camera, const mjModel *m, const mjData *d, picture_size size);

// Whether anything that moves has a shape which is shown; where not, bodies are shown as boxes of
// their inertia.
bool picture_has_shapes(const mjModel *m);

//---------------------------------- look (picture_look.c) -----------------------------------------

// Smooth round shapes; colours for geoms that have none of their own, light for a model without.
void picture_prepare_look(mjModel *m);

// After mjv_updateScene. A model without light gets a sun from the right, before and above; light
// without a place, whose shadows reach only so far, is moved to where one looks.
void picture_light(mjvScene *scene, const mjModel *m, const double centre[3]);

//---------------------------------- pixels (picture_pixels.c) -------------------------------------

// Where nothing was drawn (depth 1): a pale sky.
void picture_fill_sky(unsigned char *rgb, const float *depth, picture_size size);

// The picture at half its size, each pixel the mean of four; rows from top to bottom, GL's are from
// bottom to top. `out` may not overlap.
void picture_halve(unsigned char *out, const unsigned char *rgb, picture_size size);

// Writes rgb rows, from top to bottom, as a PNG. False where libpng fails for another reason than
// the stream.
bool picture_put_png(FILE *out, const unsigned char *rgb, picture_size size);

#endif
