// SPDX-License-Identifier: Apache-2.0
#include "figure_set.h"

#include "../draw/escape.h"
#include "files/memory_stream.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/message.h"

#include <bicycle/error.h>
#include <bicycle/output.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

FILE *figure_add(figure_set *set, const figure_words *words, plot *p) {
  if (set->count == MAX_FIGURES) return NULL;
  figure *f = &set->figures[set->count];
  *f = (figure){.name = words->name, .held = words->held, .x = p->x, .y = p->y};
  snprintf(f->title, sizeof f->title, "%s: %s", set->bicycle->name, words->title);
  char caption[FIGURE_CAPTION + BIKE_NAME_SIZE];
  snprintf(caption, sizeof caption, "Figure %s, %s. %s", words->number, set->bicycle->name,
           words->caption);
  FILE *svg = bike_memory_stream(&f->svg, &f->svg_size);
  if (!svg) return NULL;
  bool drawn = plot_write(p, words->name, f->title, caption, svg);
  set->count++; // from here on freed with the set
  if (fclose(svg) != 0 || !drawn) return NULL;
  return bike_memory_stream(&f->csv, &f->csv_size);
}

void figure_set_free(figure_set *set) {
  for (int i = 0; i < set->count; i++) {
    free(set->figures[i].svg);
    free(set->figures[i].csv);
  }
  set->count = 0;
}

const char *figure_positive_steer(const figure_set *set) {
  return term_left_sign(set->convention) > 0 ? "left" : "right";
}

typedef void writer(FILE *stream, const void *what);

static term_exit write_file(const char *folder, const char *name, const char *end, writer *write,
                            const void *what) {
  char path[TERM_PATH_SIZE];
  bike_output output;
  bike_file_error error;
  if (snprintf(path, sizeof path, "%s/%s%s", folder, name, end) >= (int)sizeof path)
    return term_fail(TERM_USAGE, "%s: path too long", folder);
  int code = bike_output_begin(&output, path, &error);
  if (!code) {
    write(output.stream, what);
    code = bike_output_commit(&output, &error);
  }
  return code ? term_fail(term_exit_of(code), "%s", error.text) : TERM_DONE;
}

static void write_svg(FILE *stream, const void *what) {
  const figure *f = what;
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", stream);
  fwrite(f->svg, 1, f->svg_size, stream);
}

static void write_csv(FILE *stream, const void *what) {
  const figure *f = what;
  fwrite(f->csv, 1, f->csv_size, stream);
}

static void write_index(FILE *out, const void *what) {
  const figure_set *set = what;
  fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>", out);
  draw_put_escaped(out, set->bicycle->name);
  fputs(": figures 2 to 4</title>\n<style>\nbody { font-family: 'DejaVu Sans', Verdana, Arial, "
        "sans-serif; max-width: 44em; margin: 2em auto; padding: 0 1em; line-height: 1.45; }\n"
        "figure { margin: 2.5em 0; }\nfigure svg { max-width: 100%; height: auto; }\n"
        "figcaption { font-size: 0.9em; }\n</style>\n</head>\n<body>\n<h1>",
        out);
  draw_put_escaped(out, set->bicycle->name);
  fputs("</h1>\n<p>Figures 2 to 4 of Franke, Suhr and Riess, \u201cAn advanced model of bicycle "
        "dynamics\u201d, Eur. J. Phys. 11 (1990) 116\u2013121, calculated anew for this bicycle "
        "with the corrected equations. The paper prints no table of parameters; those used here "
        "are the bicycle file\u2019s. ",
        out);
  fprintf(out,
          "Lean is positive to the right, steer to the %s (%s). Tables are in SI units and "
          "radians.</p>\n",
          figure_positive_steer(set),
          set->convention == BIKE_CONVENTION_SAE ? "as in the literature" : "ISO 8855");
  if (*set->note) {
    fputs("<p>", out);
    draw_put_escaped(out, set->note);
    fputs("</p>\n", out);
  }
  for (int i = 0; i < set->count; i++) {
    const figure *f = &set->figures[i];
    fprintf(out, "<figure id=\"%s\">\n", f->name);
    fwrite(f->svg, 1, f->svg_size, out);
    fputs("<figcaption>", out);
    draw_put_escaped(out, f->title);
    fprintf(out, " (<a href=\"%s.svg\">picture</a>, <a href=\"%s.csv\">table</a>)</figcaption>\n",
            f->name, f->name);
    fputs("</figure>\n", out);
  }
  fprintf(out, "<p>bicycle %s</p>\n</body>\n</html>\n", term_version());
}

term_exit figure_write_all(const figure_set *set, const char *folder) {
  if (mkdir(folder, 0777) != 0 && errno != EEXIST) return term_fail_system(errno, folder);
  term_exit code = TERM_DONE;
  for (int i = 0; i < set->count && code == TERM_DONE; i++) {
    const figure *f = &set->figures[i];
    code = write_file(folder, f->name, ".svg", write_svg, f);
    if (code == TERM_DONE) code = write_file(folder, f->name, ".csv", write_csv, f);
  }
  return code == TERM_DONE ? write_file(folder, "index", ".html", write_index, set) : code;
}
