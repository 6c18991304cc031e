// SPDX-License-Identifier: Apache-2.0
// What bicycle-sweep can do. Each returns a term_exit, or 128 + the number of the signal that ended
// it.
#ifndef SWEEP_CMD_H
#define SWEEP_CMD_H

int cmd_run(int argc, char **argv);
int cmd_merge(int argc, char **argv);
int cmd_names(int argc, char **argv);

#endif
