// SPDX-License-Identifier: Apache-2.0
// The program bicycle-sweep, reached as `bicycle sweep ...`.
#include "cmd.h"

#include "terminal/message.h"

#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
  static char sweep[] = "bicycle sweep", merge[] = "bicycle sweep merge",
              names[] = "bicycle sweep names";
  term_begin(sweep);
  if (argc > 1 && strcmp(argv[1], "merge") == 0) {
    term_begin(merge);
    argv[1] = merge;
    exit(cmd_merge(argc - 1, argv + 1));
  }
  if (argc > 1 && strcmp(argv[1], "names") == 0) {
    term_begin(names);
    argv[1] = names;
    exit(cmd_names(argc - 1, argv + 1));
  }
  if (argc > 0) argv[0] = sweep;
  return cmd_run(argc, argv);
}
