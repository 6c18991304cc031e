// SPDX-License-Identifier: Apache-2.0
// bicycle mujoco ride, of a model that is no bicycle: rows of its joints, sensors and discs.
#include "cmd_columns.h"
#include "cmd_ride.h"
#include "cmd_tally.h"

#include <bicycle/error.h>
#include <stdlib.h>

// All that one ride needs.
typedef struct outing {
  runner_any *run;
  const cmd_ride_arguments *args;
  term_ride *ride;
  cmd_columns columns;
  cmd_disc *discs;
  cmd_sensors sensors;
  cmd_shot shot;
  bool full; // out of memory
} outing;

static const char *file_of(const outing *o) {
  return o->args->ride.start.file;
}

// What is said of bicycles alone.
static term_exit check_options(const cmd_ride_arguments *args, const char *why) {
  const char *file = args->ride.start.file, *option = NULL;
  if (args->ride.show.convention != BIKE_CONVENTION_ISO) option = "--convention";
  if (args->ride.lean_limit != runner_default_ride_def().lean_limit) option = "--lean-limit";
  if (args->ride.action) option = args->ride.action;
  if (args->ride.limits.reach > 0) option = "--reach";
  if (args->has_start) option = "--speed and the like";
  if (!option) return TERM_DONE;
  return term_fail(TERM_USAGE, "%s: %s: only for a bicycle (%s)", file, option, why);
}

//---------------------------------- rows ----------------------------------------------------------

// The first moment has the names of what rolls.
static bool begin_rows(outing *o, const runner_moment *moment) {
  int count = runner_any_disc_count(o->run);
  if (!cmd_columns_begin(&o->columns, runner_any_model(o->run), moment, count,
                         runner_any_drive_count(o->run)))
    return false;
  for (int i = 0; i < count; i++) o->discs[i].name = moment->discs[i].name;
  if (o->ride->output.stream) cmd_columns_put_header(o->ride->output.stream, &o->columns);
  if (o->ride->record.columns) cmd_columns_make_json(o->ride->record.columns, &o->columns);
  return true;
}

static void take_disc(const outing *o, int i, double time, const roll_disc *now) {
  cmd_disc_take(&o->discs[i], mju_norm3(now->slip), now->height);
  cmd_disc_press(&o->discs[i], time, now->force, now->normal_force, o->args->ride.limits.friction);
}

static int take(const runner_moment *moment, void *user) {
  outing *o = user;
  if (!o->columns.names && !begin_rows(o, moment)) {
    o->full = true;
    return 1;
  }
  cmd_columns_take(&o->columns, moment);
  for (int i = 0; i < runner_any_disc_count(o->run); i++)
    take_disc(o, i, moment->time, &moment->discs[i]);
  cmd_sensors_take(&o->sensors, moment->data->sensordata);
  cmd_shot_take(&o->shot, moment->time, moment->data->qpos);
  if (o->ride->output.stream) cmd_columns_put_row(o->ride->output.stream, &o->columns);
  if (o->ride->record.columns) cmd_columns_add_json(o->ride->record.columns, &o->columns);
  return term_ride_count(o->ride, moment->time);
}

static void take_lift(int disc, double time, void *user) {
  const outing *o = user;
  cmd_disc_lift(&o->discs[disc], time);
}

static void take_note(const char *text, void *user) {
  const outing *o = user;
  term_progress_clear(&o->ride->record.progress);
  term_message("%s: %s", file_of(o), text);
}

//---------------------------------- reports -------------------------------------------------------

static bool print_json(const outing *o, const runner_any_result *result, const char *error) {
  int count = runner_any_disc_count(o->run);
  const mjModel *model = runner_any_model(o->run);
  double factor = result->wall_time > 0 ? result->end_time / result->wall_time : 0;
  json_t *document =
      json_pack("{s:s, s:o, s:b, s:I, s:o, s:o, s:o, s:I, s:o}", "model", model->names, "end_time",
                term_json_number(result->end_time), "complete", result->complete, "rows",
                (json_int_t)o->ride->record.count, "end", cmd_columns_json(&o->columns), "discs",
                cmd_discs_json(o->discs, count), "timestep", term_json_number(model->opt.timestep),
                "steps", (json_int_t)result->steps, "real_time_factor", term_json_number(factor));
  json_object_set_new(document, "outside_physics",
                      cmd_discs_outside_json(o->discs, count, &o->args->ride.limits));
  if (o->args->sensors) json_object_set_new(document, "sensors", cmd_sensors_json(&o->sensors));
  if (error) json_object_set_new(document, "error", json_string(error));
  if (o->ride->record.columns) json_object_set(document, "samples", o->ride->record.columns);
  return term_json_write(document, stdout);
}

static term_exit report(outing *o, const runner_any_result *result, const char *error,
                        term_exit code) {
  if (!term_ride_close(o->ride, &code)) return code;
  double factor = result->wall_time > 0 ? result->end_time / result->wall_time : 0;
  int count = runner_any_disc_count(o->run);
  for (int i = 0; i < count; i++) bike_ground_end(&o->discs[i].ground, result->end_time);
  cmd_discs_tell(o->discs, count);
  cmd_discs_outside_tell(o->discs, count, &o->args->ride.limits);
  cmd_sensors_tell(&o->sensors);
  term_message("%ld rows to %.9g s, %.0f times real time", o->ride->record.count, result->end_time,
               factor);
  if (o->args->ride.show.json && !print_json(o, result, error))
    code = term_fail_bike(BIKE_ERROR_MEMORY, file_of(o));
  return cmd_shot_end(&o->shot, code);
}

static term_exit ride(outing *o) {
  const term_ride_options *options = &o->args->ride;
  const runner_any_def def = {.duration = options->duration,
                              .sample = options->sample,
                              .stop_at_lift = options->stop_at_lift,
                              .on_sample = take,
                              .on_lift = take_lift,
                              .on_note = take_note,
                              .user = o};
  runner_any_result result;
  mjcf_error error = {.text = ""};
  runner_status status = runner_any_ride(&result, o->run, &def, &error);
  term_ride_stop(o->ride);
  if (o->full) return term_fail_bike(BIKE_ERROR_MEMORY, file_of(o));
  // A stream that takes no more rows is reported when it is committed.
  bool whole = status == RUNNER_OK || status == RUNNER_INTERRUPTED;
  term_exit code =
      whole ? TERM_DONE
            : term_fail((term_exit)runner_exit_code(status), "%s: %s", file_of(o), error.text);
  return report(o, &result, whole ? NULL : error.text, code);
}

//---------------------------------- preparation ---------------------------------------------------

static term_exit start(const outing *o) {
  mjcf_error error = {.text = ""};
  double moved;
  runner_status status = runner_any_start(o->run, o->args->project, &moved, &error);
  const char *hint = status == RUNNER_START && !o->args->project ? "; --project puts it right" : "";
  if (status != RUNNER_OK)
    return term_fail((term_exit)runner_exit_code(status), "%s: %s%s", file_of(o), error.text, hint);
  if (moved > 0)
    term_message("%s: the start was put right: no coordinate or rate moved by more than %.3g",
                 file_of(o), moved);
  return TERM_DONE;
}

static term_exit prepare(outing *o) {
  mjModel *model = runner_any_model(o->run);
  const runner_any_def def = {
      .duration = o->args->ride.duration, .sample = o->args->ride.sample, .on_sample = take};
  mjcf_error refusal;
  cmd_adjust_model(model, &o->args->model);
  if (runner_any_check(o->run, &def, &refusal) != RUNNER_OK)
    return term_fail(TERM_USAGE, "%s: %s", file_of(o), refusal.text);
  o->discs = (cmd_disc *)calloc((size_t)runner_any_disc_count(o->run) + 1, sizeof *o->discs);
  if (!o->discs || (o->args->sensors && !cmd_sensors_begin(&o->sensors, model)))
    return term_fail_bike(BIKE_ERROR_MEMORY, file_of(o));
  term_exit code = start(o);
  return code == TERM_DONE ? cmd_shot_begin(&o->shot, &o->args->picture, model) : code;
}

term_exit cmd_ride_any(runner_any *any, const cmd_ride_arguments *args, term_ride *ride_to,
                       const char *why) {
  outing o = {.run = any, .args = args, .ride = ride_to};
  term_exit code = check_options(args, why);
  if (code == TERM_DONE) code = prepare(&o);
  if (code == TERM_DONE) {
    term_message("%s: %s; it rides in its own coordinates", file_of(&o), why);
    code = ride(&o);
  }
  cmd_shot_free(&o.shot);
  cmd_sensors_free(&o.sensors);
  cmd_columns_free(&o.columns);
  free(o.discs);
  return code;
}
