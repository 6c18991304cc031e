// SPDX-License-Identifier: Apache-2.0
#include "plot_file.h"

#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/message.h"

#include <bicycle/error.h>
#include <bicycle/output.h>
#include <string.h>

static const char suffix[] = ".svg";

const char *plot_name_of(const char *text) {
  if (!term_ends_with(text, suffix)) term_usage("-o: '%s' is not the name of an .svg file", text);
  return text;
}

static term_exit save_picture(plot *p, const char *id, const char *title, const char *caption,
                              const char *path) {
  bike_output output;
  bike_file_error error;
  int code = bike_output_begin(&output, path, &error);
  if (code) return term_fail(term_exit_of(code), "%s", error.text);
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", output.stream);
  if (!plot_write(p, id, title, caption, output.stream)) {
    bike_output_abort(&output);
    return term_fail_bike(BIKE_ERROR_MEMORY, path);
  }
  code = bike_output_commit(&output, &error);
  return code ? term_fail(term_exit_of(code), "%s", error.text) : TERM_DONE;
}

static term_exit save_table(plot_table *table, const void *user, const char *path) {
  bike_output output;
  bike_file_error error;
  int code = bike_output_begin(&output, path, &error);
  if (code) return term_fail(term_exit_of(code), "%s", error.text);
  table(output.stream, user);
  code = bike_output_commit(&output, &error);
  return code ? term_fail(term_exit_of(code), "%s", error.text) : TERM_DONE;
}

term_exit plot_save(plot *p, const char *id, const char *title, const char *caption,
                    const char *svg, plot_table *table, const void *user) {
  char csv[TERM_PATH_SIZE];
  int stem = (int)(strlen(svg) - strlen(suffix));
  if (snprintf(csv, sizeof csv, "%.*s.csv", stem, svg) >= (int)sizeof csv)
    return term_fail(TERM_USAGE, "%s: path too long", svg);
  term_exit code = save_picture(p, id, title, caption, svg);
  return code == TERM_DONE ? save_table(table, user, csv) : code;
}
