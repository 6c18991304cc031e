// SPDX-License-Identifier: Apache-2.0
// `bicycle NAME ...`: a command of its own, or the program bicycle-NAME that stands beside it.
#include "commands.h"
#include "terminal/command.h"
#include "terminal/data.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const term_command commands[] = {
    {"state", cmd_state, "Everything there is to know of the bicycle at one instant"},
    {"ride", cmd_ride, "Ride it for a while: a CSV of the motion"},
    {"linear", cmd_linear, "The linearised equations of motion"},
    {"stability", cmd_stability, "Eigenvalues, weave and capsize speeds of riding straight"},
    {"turn", cmd_turn, "Stationary circles: all that have two given values"},
    {"effects", cmd_effects, "What every parameter does to the weave and capsize speeds"},
    {"cycle", cmd_cycle, "The limit cycle that is left beyond the weave speed"},
    {"basin", cmd_basin, "From which leans and steers it comes back to riding straight"},
    {"figures", cmd_figures, "The paper's figures 2 to 4 for any bicycle, as SVG and CSV"},
    {"draw", cmd_draw, "A side view with every length named, as SVG"},
};

enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

// Programs beside this one that are part of the project.
static const term_command neighbours[] = {
    {"sweep", NULL, "Many bicycles, starts and speeds, on one machine or many (bicycle-sweep)"},
    {"mujoco", NULL, "The same bicycle in MuJoCo (program bicycle-mujoco)"},
    {"validate", NULL, "Compare the two simulators (program bicycle-validate)"},
};

enum { NEIGHBOUR_COUNT = sizeof neighbours / sizeof neighbours[0] };

static void print_list(const term_command *list, int count) {
  for (int i = 0; i < count; i++) printf("  %-10s  %s\n", list[i].name, list[i].summary);
}

static void print_help(void) {
  fputs("Example: bicycle stability benchmark\n"
        "         bicycle ride roadster --speed 6 --lean-rate 0.2 --time 10 --sample 0.01\n\n"
        "Usage: bicycle COMMAND [OPTION...]\n"
        "       bicycle COMMAND --help\n\n"
        "The nonlinear bicycle of Franke, Suhr and Riess (1990). Commands:\n",
        stdout);
  print_list(commands, COMMAND_COUNT);
  print_list(neighbours, NEIGHBOUR_COUNT);
  fputs("\nAny other NAME runs bicycle-NAME found beside this program.\n"
        "A bicycle is a file, or the name of a shipped one, as in 'benchmark'.\n"
        "Units are SI and radians; an angle may end in deg, as in -5deg.\n"
        "Signs are ISO 8855: lean right, steer, yaw and y left positive.\n\n"
        "Exit status: 0 done or agreed; 1 the comparison failed; 2 wrong usage or input;\n"
        "3 the run is invalid; 4 the baseline is missing or does not fit.\n",
        stdout);
}

// Becomes bicycle-NAME; returns only when that is impossible.
static term_exit run_neighbour(char **argv) {
  char path[TERM_PATH_SIZE], program[TERM_PATH_SIZE];
  const char *name = argv[1];
  if (!*name || strchr(name, '/'))
    return term_fail(TERM_USAGE, "'%s' is not a command (see bicycle --help)", name);
  if (snprintf(program, sizeof program, "bicycle-%s", name) >= (int)sizeof program ||
      !term_path_beside(path, program))
    return term_fail(TERM_USAGE, "the name of the command is too long");
  argv[1] = program;
  execv(path, argv + 1);
  if (errno != ENOENT) return term_fail(TERM_USAGE, "%s: %s", path, strerror(errno));
  return term_fail(TERM_USAGE, "'%s' is not a command (see bicycle --help)", name);
}

static int run_command(const term_command *command, int argc, char **argv) {
  char name[64];
  snprintf(name, sizeof name, "bicycle %s", command->name);
  term_begin(name);
  argv[0] = name;
  exit(command->run(argc, argv)); // here, while `name` lives
}

int main(int argc, char **argv) {
  term_begin("bicycle");
  if (argc < 2) return term_fail(TERM_USAGE, "a command is missing (see bicycle --help)");
  const char *name = argv[1];
  if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
    print_help();
    return TERM_DONE;
  }
  if (strcmp(name, "--version") == 0) {
    printf("bicycle %s\n", term_version());
    return TERM_DONE;
  }
  if (name[0] == '-')
    return term_fail(TERM_USAGE, "unrecognized option '%s' (see bicycle --help)", name);
  for (int i = 0; i < COMMAND_COUNT; i++)
    if (strcmp(name, commands[i].name) == 0) return run_command(&commands[i], argc - 1, argv + 1);
  return run_neighbour(argv);
}
