// SPDX-License-Identifier: Apache-2.0
// A single plot and its table as files, X.svg and X.csv.
#ifndef BICYCLE_CLI_FIGURES_PLOT_FILE_H
#define BICYCLE_CLI_FIGURES_PLOT_FILE_H

#include "plot.h"
#include "terminal/exit_code.h"

// The value of -o: "X.svg". Another text ends the program through term_usage.
const char *plot_name_of(const char *text);

// Called to fill a table.
typedef void plot_table(FILE *csv, const void *user);

// Writes the plot to `svg`, which ends in ".svg", and the table beside it; each appears whole or
// not at all. id, title and caption as for plot_write. On failure one line is printed.
term_exit plot_save(plot *p, const char *id, const char *title, const char *caption,
                    const char *svg, plot_table *table, const void *user);

#endif
