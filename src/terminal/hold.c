// SPDX-License-Identifier: Apache-2.0
#include "terminal/hold.h"

static sigset_t ending_signals(void) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGHUP);
  sigaddset(&set, SIGQUIT);
  return set;
}

void term_hold_signals(sigset_t *before) {
  const sigset_t ending = ending_signals();
  pthread_sigmask(SIG_BLOCK, &ending, before);
}

bool term_signal_waits(void) {
  const sigset_t ending = ending_signals();
  sigset_t waiting, both;
  sigemptyset(&waiting);
  sigpending(&waiting);
  sigandset(&both, &waiting, &ending);
  return !sigisemptyset(&both);
}

void term_release_signals(const sigset_t *before) {
  pthread_sigmask(SIG_SETMASK, before, NULL);
}
