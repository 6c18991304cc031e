// SPDX-License-Identifier: Apache-2.0
// --picture: one moment of a ride as a PNG.
#ifndef PLUGIN_CMD_PICTURE_H
#define PLUGIN_CMD_PICTURE_H

#include "picture.h"

#include "terminal/command.h"

#include <bicycle/output.h>

// What was asked for.
typedef struct cmd_picture {
  const char *output; // NULL: no picture
  double at;          // s  NAN: the end of the ride
  picture_size size;  //
  const char *camera; // NULL: what moves, framed
} cmd_picture;

// None, and 1280x800 at the end.
cmd_picture cmd_no_picture(void);

// --picture, --picture-at, --size, --camera: a child parser whose input is a cmd_picture.
extern const struct argp cmd_picture_argp;

// Ends the program where it does not fit the ride.
void cmd_check_picture(const cmd_picture *asked, double duration, const char *rows);

// The picture of a ride under way.
typedef struct cmd_shot {
  const cmd_picture *asked; // must stay valid
  picture *picture;         // NULL: none is asked for
  bike_output output;       //
  double *qpos;             // of the newest row until the moment asked for
  int nq;                   //
  double time;              // s  of that; below 0 as long as there is none
} cmd_shot;

// Before the ride, so that a folder that cannot be written, a camera that is not there, or a
// machine without OSMesa (TERM_INVALID) is found before it. `model` is the one that rides or, with
// the same joints, one that looks better. Reports what is wrong.
term_exit cmd_shot_begin(cmd_shot *out, const cmd_picture *asked, const mjModel *model);

// A row of the ride.
void cmd_shot_take(cmd_shot *shot, double time, const double *qpos);

// After the ride: renders the moment asked for, or the last row where the ride ended before.
// Returns `code`, or how the program ends where that was TERM_DONE and the picture failed.
term_exit cmd_shot_end(cmd_shot *shot, term_exit code);

// Leaves no half-written picture; does nothing to a shot that is zeroed.
void cmd_shot_free(cmd_shot *shot);

#endif
