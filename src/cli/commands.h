// SPDX-License-Identifier: Apache-2.0
// The commands of the program `bicycle`: each runs with argv[0] = "bicycle NAME" and returns a
// term_exit.
#ifndef BICYCLE_CLI_COMMANDS_H
#define BICYCLE_CLI_COMMANDS_H

int cmd_basin(int argc, char **argv);
int cmd_cycle(int argc, char **argv);
int cmd_draw(int argc, char **argv);
int cmd_effects(int argc, char **argv);
int cmd_figures(int argc, char **argv);
int cmd_linear(int argc, char **argv);
int cmd_ride(int argc, char **argv);
int cmd_stability(int argc, char **argv);
int cmd_state(int argc, char **argv);
int cmd_turn(int argc, char **argv);

#endif
