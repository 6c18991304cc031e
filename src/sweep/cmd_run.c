// SPDX-License-Identifier: Apache-2.0
// bicycle sweep SPEC.yml: the command line.
#include "cmd.h"

#include "run.h"
#include "terminal/command.h"
#include "terminal/number.h"
#include "terminal/threads.h"

#include <string.h>

static const char example[] = "Example: bicycle sweep SPEC.yml -o map\n"
                              "         bicycle sweep SPEC.yml -o map --shard 3/8\n"
                              "         mpirun -n 9 bicycle sweep SPEC.yml -o map\n"
                              "         bicycle sweep merge map.*of8.log -o map.csv\n"
                              "         bicycle sweep names roadster\n\n"
                              "with SPEC.yml, as in share/bicycle/sweep/trail_and_speed.yml:\n"
                              "         bicycle: roadster\n"
                              "         sweep:\n"
                              "           geometry.trail: {from: 0.02, to: 0.1, count: 9}\n"
                              "           speed: [4, 5, 6, 7]\n"
                              "         outputs: [weave_speed, capsize_speed, eps_max]\n";

static const char documentation[] =
    "Asks the same questions of many bicycles, starts and speeds. RESULT.log takes a record of "
    "each point as soon as it is done, so that the same command, after whatever ended it, goes on "
    "with the points that are left; RESULT.csv, the table in the order of the points, is written "
    "when all are done. `merge` makes the table of a sweep's shards, `names` lists what can be "
    "changed in a bicycle.\v"
    "SPEC.yml: bicycle (a file, from the folder of SPEC.yml, or a shipped name); sweep: NAME: "
    "VALUES, VALUES a number, a list, {from, to, count}, {uniform: [LOW, HIGH]}, {normal: [MEAN, "
    "DEVIATION]} or {normal: file}; outputs: a list of weave_speed, capsize_speed, stable_ranges, "
    "eps_max, turn_eps_max, outcome, time; draws and seed where axes are drawn; search: [LOW, "
    "HIGH], m/s; ride: {time, settled, start_speed: given | same_energy}; front: in_space | "
    "on_axis. Units are SI and radians.\n\n"
    "Exit status: 0 done; 2 wrong usage or input; 3 no point has all its outputs; 130, 143 stopped "
    "by a "
    "signal.";

enum { KEY_THREADS = TERM_KEY_FIRST, KEY_SHARD, KEY_FRESH, KEY_JSON };
static void take_shard(sweep_shard *out, const char *text) {
  const char *why = "";
  if (!sweep_parse_shard(out, text, &why)) term_usage("--shard: '%s': %s", text, why);
}

static error_t parse(int key, char *text, struct argp_state *state) {
  sweep_run *run = state->input;
  switch (key) {
  case 'o':
    if (!*text || text[strlen(text) - 1] == '/') term_usage("-o: '%s' is not a file's name", text);
    if (term_ends_with(text, ".csv")) text[strlen(text) - strlen(".csv")] = '\0';
    run->result = text;
    return 0;
  case KEY_THREADS:
    run->threads = term_threads_of("--threads", text);
    return 0;
  case KEY_SHARD:
    take_shard(&run->shard, text);
    return 0;
  case KEY_FRESH:
    run->fresh = true;
    return 0;
  case KEY_JSON:
    run->json = true;
    return 0;
  case ARGP_KEY_ARG:
    term_take_argument(&run->spec_path, text, "SPEC.yml");
    return 0;
  case ARGP_KEY_END:
    if (!run->spec_path) term_usage("SPEC.yml is missing");
    if (!run->result) term_usage("-o RESULT is missing");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"output", 'o', "RESULT", 0, "What RESULT.log and RESULT.csv are called (required)", 1},
    {"threads", KEY_THREADS, "N", 0, "Threads (all processors; one for each MPI rank)", 1},
    {"shard", KEY_SHARD, "K/N|slurm", 0,
     "Only part K of N, K from 1, into RESULT.KofN.log; slurm: what SLURM_ARRAY_TASK_ID says", 1},
    {"fresh", KEY_FRESH, NULL, 0, "Start over, whatever RESULT.log holds", 1},
    {"json", KEY_JSON, NULL, 0, "Print one JSON document", 8},
    {0},
};

int cmd_run(int argc, char **argv) {
  const struct argp argp = {options, parse, "SPEC.yml", documentation, NULL, NULL, NULL};
  sweep_run run = {.shard = {1, 1}};
  term_parse(&argp, example, argc, argv, &run);
  return sweep_run_all(&run);
}
