// SPDX-License-Identifier: Apache-2.0
// Signals that end a program from outside (SIGINT, SIGTERM, SIGHUP, SIGQUIT) wait while something
// is written that is to be whole or not there. Of the calling thread: where others run that do not
// block them, they do not wait.
#ifndef BICYCLE_TERMINAL_HOLD_H
#define BICYCLE_TERMINAL_HOLD_H

#include <signal.h>
#include <stdbool.h>

// From here on they wait; `before` keeps what was blocked.
void term_hold_signals(sigset_t *before);

// Whether one waits: what follows need not be written.
bool term_signal_waits(void);

// As before; one that has waited ends the program here, unless somebody else blocks or catches it.
void term_release_signals(const sigset_t *before);

#endif
