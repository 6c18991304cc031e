// SPDX-License-Identifier: Apache-2.0
// Commands of bicycle-validate on saved reports; argv[0] is the command's own name.
#ifndef VALIDATE_CMD_H
#define VALIDATE_CMD_H

int cmd_compare(int argc, char **argv);
int cmd_bless(int argc, char **argv);

#endif
