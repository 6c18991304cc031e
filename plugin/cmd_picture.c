// SPDX-License-Identifier: Apache-2.0
#include "cmd_picture.h"

#include "terminal/number.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

//---------------------------------- command line --------------------------------------------------

enum { KEY_PICTURE = TERM_KEY_FIRST, KEY_AT, KEY_SIZE, KEY_CAMERA };

cmd_picture cmd_no_picture(void) {
  return (cmd_picture){.at = NAN};
}

// "WxH", both within what a picture may have.
static picture_size size_of(const char *text) {
  char width[16] = "";
  const char *cross = strchr(text, 'x');
  long numbers[2];
  if (cross && (size_t)(cross - text) < sizeof width) memcpy(width, text, (size_t)(cross - text));
  if (!cross || !term_parse_integer(&numbers[0], width, PICTURE_LEAST_SIZE, PICTURE_MOST_SIZE) ||
      !term_parse_integer(&numbers[1], cross + 1, PICTURE_LEAST_SIZE, PICTURE_MOST_SIZE))
    term_usage("--size: '%s' is not WxH, each %d to %d pixels", text, PICTURE_LEAST_SIZE,
               PICTURE_MOST_SIZE);
  return (picture_size){(int)numbers[0], (int)numbers[1]};
}

static double time_of(const char *text) {
  double time = term_number_of("--picture-at", text);
  if (time < 0) term_usage("--picture-at: %s is before the ride", text);
  return time;
}

static void check_complete(cmd_picture *asked) {
  bool others = !isnan(asked->at) || asked->size.width > 0 || asked->camera;
  if (!asked->output && others)
    term_usage("--picture-at, --size and --camera are for a picture: --picture is missing");
  if (asked->output && !term_ends_with(asked->output, ".png"))
    term_usage("--picture: '%s' does not end in .png", asked->output);
  if (asked->size.width == 0) asked->size = (picture_size){1280, 800};
}

static error_t parse(int key, char *text, struct argp_state *state) {
  cmd_picture *asked = state->input;
  switch (key) {
  case KEY_PICTURE:
    asked->output = text;
    return 0;
  case KEY_AT:
    asked->at = time_of(text);
    return 0;
  case KEY_SIZE:
    asked->size = size_of(text);
    return 0;
  case KEY_CAMERA:
    asked->camera = text;
    return 0;
  case ARGP_KEY_END:
    check_complete(asked);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"picture", KEY_PICTURE, "X.png", 0, "Render a moment of the ride; needs no display", 6},
    {"picture-at", KEY_AT, "T", 0, "Its time, s: the first row at or after it (the last row)", 6},
    {"size", KEY_SIZE, "WxH", 0, "Its size in pixels (1280x800)", 6},
    {"camera", KEY_CAMERA, "NAME", 0, "A camera of the model (all that moves, framed)", 6},
    {0},
};

const struct argp cmd_picture_argp = {.options = options, .parser = parse};

void cmd_check_picture(const cmd_picture *asked, double duration, const char *rows) {
  if (asked->at > duration)
    term_usage("--picture-at %g is after the ride of --time %g", asked->at, duration);
  if (asked->output && rows && strcmp(asked->output, rows) == 0)
    term_usage("--picture and -o both mean '%s'", rows);
}

//---------------------------------- the picture ---------------------------------------------------

static term_exit exit_of(picture_status status) {
  if (status == PICTURE_OK) return TERM_DONE;
  return status == PICTURE_ARGUMENT ? TERM_USAGE : TERM_INVALID;
}

term_exit cmd_shot_begin(cmd_shot *out, const cmd_picture *asked, const mjModel *model) {
  *out = (cmd_shot){.asked = asked, .nq = model->nq, .time = -1};
  if (!asked->output) return TERM_DONE;
  bike_file_error refused;
  int code = bike_output_begin(&out->output, asked->output, &refused);
  if (code != BIKE_OK) return term_fail(term_exit_of(code), "%s", refused.text);
  picture_status status;
  mjcf_error error;
  out->picture = picture_create(model, asked->size, asked->camera, &status, &error);
  out->qpos = (double *)calloc((size_t)model->nq + 1, sizeof *out->qpos);
  if (out->picture && out->qpos) return TERM_DONE;
  if (out->picture) return term_fail_bike(BIKE_ERROR_MEMORY, asked->output);
  return term_fail(exit_of(status), "--picture: %s", error.text);
}

void cmd_shot_take(cmd_shot *shot, double time, const double *qpos) {
  // Rows are at k * sample, times are typed in decimals: half a rounding must not miss one.
  bool is_there = shot->time >= shot->asked->at - 1e-9;
  if (!shot->picture || (shot->time >= 0 && is_there)) return;
  mju_copy(shot->qpos, qpos, shot->nq);
  shot->time = time;
}

term_exit cmd_shot_end(cmd_shot *shot, term_exit code) {
  if (!shot->picture || shot->time < 0) return code;
  if (shot->time < shot->asked->at - 1e-9)
    term_message("%s: the ride ended before; the picture is of %.6g s", shot->asked->output,
                 shot->time);
  mjcf_error error;
  bike_file_error lost;
  term_exit end = exit_of(picture_write(shot->output.stream, shot->picture, shot->qpos, &error));
  if (end != TERM_DONE)
    term_fail(end, "%s: %s", shot->asked->output, error.text);
  else if (bike_output_commit(&shot->output, &lost) != BIKE_OK)
    end = term_fail(TERM_USAGE, "%s", lost.text);
  return code == TERM_DONE ? end : code;
}

void cmd_shot_free(cmd_shot *shot) {
  bike_output_abort(&shot->output);
  picture_free(shot->picture);
  free(shot->qpos);
  *shot = (cmd_shot){0};
}
