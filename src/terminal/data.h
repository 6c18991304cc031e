// SPDX-License-Identifier: Apache-2.0
// Shipped data, found relative to the program, and bicycles by file or by name.
#ifndef BICYCLE_TERMINAL_DATA_H
#define BICYCLE_TERMINAL_DATA_H

#include "terminal/message.h"

#include <bicycle/bicycle.h>
#include <bicycle/file.h>
#include <bicycle/model.h>
#include <stdbool.h>

enum { TERM_PATH_SIZE = 4096 }; // PATH_MAX of Linux

// "FOLDER/NAME", FOLDER being that of the running program. False when it does not fit.
bool term_path_beside(char out[TERM_PATH_SIZE], const char *name);

// A shipped file or folder: "model/benchmark/benchmark.yml", "scenarios".
bool term_data_path(char out[TERM_PATH_SIZE], const char *name);

// Where a bicycle stands: a name without slash and point is a shipped bicycle where there is one
// of that name, so that the current folder does not matter; anything else is the path itself.
bool term_bicycle_path(char out[TERM_PATH_SIZE], const char *file);

// Reads a bicycle's file with all that it holds. On failure one line is printed.
term_exit term_load_file(bike_file *out, const char *file);

// Reads a bicycle and lumps it; `model` may be NULL. On failure one line is printed.
term_exit term_load_bicycle(bike_bicycle *bicycle, bike_model *model, const char *file);

#endif
