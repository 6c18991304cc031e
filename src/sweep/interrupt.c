// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t asked;

static void note(int number) {
  asked = number;
}

// What is ignored from the start stays so: a script's job in the background is not to end with it.
static void listen_to(int number, const struct sigaction *action) {
  struct sigaction old;
  if (sigaction(number, NULL, &old) == 0 && old.sa_handler != SIG_IGN)
    sigaction(number, action, NULL);
}

void sweep_listen_to_signals(void) {
  struct sigaction action = {.sa_handler = note, .sa_flags = (int)(SA_RESTART | SA_RESETHAND)};
  sigemptyset(&action.sa_mask);
  listen_to(SIGINT, &action);
  listen_to(SIGTERM, &action);
}

int sweep_interrupted(void) {
  return (int)asked;
}
