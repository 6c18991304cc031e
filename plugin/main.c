// SPDX-License-Identifier: Apache-2.0
// The program bicycle-mujoco, reached as `bicycle mujoco COMMAND ...`.
#include "cmd.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const term_command commands[] = {
    {"mjcf", cmd_mjcf, "Write a bicycle as a MuJoCo model"},
    {"import", cmd_import, "Read the bicycle out of anybody's MuJoCo model"},
    {"ride", cmd_ride, "Ride it, or any model that rolls, in MuJoCo"},
};

enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static void print_help(void) {
  fputs(
      "Example: bicycle mujoco mjcf roadster -o roadster.xml\n"
      "         bicycle mujoco ride roadster --speed 6 --lean-rate 0.2 --time 10 --sample 0.01\n\n"
      "Usage: bicycle mujoco COMMAND [OPTION...]\n"
      "       bicycle mujoco COMMAND --help\n\n"
      "The bicycle in MuJoCo, its wheels rolling exactly. Commands:\n",
      stdout);
  for (int i = 0; i < COMMAND_COUNT; i++)
    printf("  %-6s  %s\n", commands[i].name, commands[i].summary);
}

int main(int argc, char **argv) {
  term_begin("bicycle mujoco");
  if (argc < 2) return term_fail(TERM_USAGE, "a command is missing (see bicycle mujoco --help)");
  const char *name = argv[1];
  if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
    print_help();
    return TERM_DONE;
  }
  if (strcmp(name, "--version") == 0) {
    printf("bicycle mujoco %s (MuJoCo %s)\n", term_version(), mj_versionString());
    return TERM_DONE;
  }
  for (int i = 0; i < COMMAND_COUNT; i++) {
    if (strcmp(name, commands[i].name) != 0) continue;
    char program[64];
    snprintf(program, sizeof program, "bicycle mujoco %s", name);
    term_begin(program);
    argv[1] = program;
    exit(commands[i].run(argc - 1, argv + 1)); // here, while `program` lives
  }
  return term_fail(TERM_USAGE, "'%s' is not a command (see bicycle mujoco --help)", name);
}
