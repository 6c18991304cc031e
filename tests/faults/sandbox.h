// SPDX-License-Identifier: Apache-2.0
// Commands run in a folder that is emptied before each, and what they leave there.
#ifndef BICYCLE_TESTS_FAULTS_SANDBOX_H
#define BICYCLE_TESTS_FAULTS_SANDBOX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

enum { SANDBOX_MOST_FILES = 512, SANDBOX_PATH = 200 };

// What stands in the folder, the standard output as "stdout" among it.
typedef struct sandbox_file {
  char path[SANDBOX_PATH]; // within the folder
  size_t size;
  uint64_t hash;
} sandbox_file;

typedef struct sandbox_content {
  int count;
  sandbox_file files[SANDBOX_MOST_FILES]; // sorted by path
} sandbox_content;

// Makes the folders HOME/in, for inputs, and HOME/run, where commands run; removed at exit.
// Whatever fails here ends the program.
void sandbox_enter(void);
const char *sandbox_home(void);

// Runs a shell command in HOME/run that must succeed, with the programs of the build in PATH.
void sandbox_shell(const char *command);

// Empties HOME/run.
void sandbox_clean(void);

// Starts a program of the build in HOME/run; words of the command are separated by blanks. Its
// output goes to HOME/run/stdout and HOME/stderr. `preload` is a library, or NULL; `ledger` a
// descriptor that it inherits, or -1. It is killed by SIGALRM after `seconds`.
pid_t sandbox_start(const char *command, const char *preload, int ledger, unsigned seconds);

// Waits for it; the status of waitpid.
int sandbox_wait(pid_t child);

void sandbox_look(sandbox_content *out);
const sandbox_file *sandbox_find(const sandbox_content *content, const char *path);
bool sandbox_same(const sandbox_content *a, const sandbox_content *b);

// The first lines of HOME/stderr, on one line.
void sandbox_message(char *out, size_t size);

#endif
