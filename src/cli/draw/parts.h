// SPDX-License-Identifier: Apache-2.0
// What a bicycle is made of, in its picture.
#ifndef BICYCLE_CLI_DRAW_PARTS_H
#define BICYCLE_CLI_DRAW_PARTS_H

#include "view.h"

void draw_ground(draw_view *view, double from, double to); // pixels
void draw_wheels(draw_view *view);
void draw_frames(draw_view *view); // the lines L_r and L_s, L_f, which are all they need be
void draw_centres_of_mass(draw_view *view);

#endif
