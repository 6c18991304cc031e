// SPDX-License-Identifier: Apache-2.0
#include "figure_list.h"

#include "terminal/message.h"

#include <stdlib.h>

static json_t *path_json(const char *folder, const char *name, const char *end) {
  char *path = NULL;
  if (asprintf(&path, "%s/%s%s", folder, name, end) < 0) {
    term_lose();
    return NULL;
  }
  json_t *out = term_json_text(path);
  free(path);
  return out;
}

static json_t *axis_json(const plot_axis *axis) {
  const plot_title *t = &axis->title;
  return json_pack("{s:s, s:o, s:s, s:o, s:o}", "quantity", t->words, "symbol",
                   json_sprintf("%s%s%s", t->symbol, *t->subscript ? "_" : "", t->subscript),
                   "unit", t->unit, "from", term_json_number(axis->low), "to",
                   term_json_number(axis->high));
}

static json_t *figure_json(const figure *f, const char *folder) {
  return json_pack("{s:s, s:s, s:o, s:o, s:o, s:o, s:s}", "name", f->name, "title", f->title,
                   "picture", path_json(folder, f->name, ".svg"), "table",
                   path_json(folder, f->name, ".csv"), "x", axis_json(&f->x), "y", axis_json(&f->y),
                   "held", f->held);
}

json_t *figure_list_json(const figure_set *set, const char *folder, bike_convention convention) {
  json_t *figures = json_array();
  for (int i = 0; i < set->count; i++)
    json_array_append_new(figures, figure_json(&set->figures[i], folder));
  return json_pack("{s:s, s:s, s:o, s:o, s:o, s:o}", "bicycle", set->bicycle->name, "convention",
                   term_convention_name(convention), "folder", term_json_text(folder), "page",
                   path_json(folder, "index", ".html"), "figures", figures, "missing",
                   *set->note ? json_string(set->note) : json_null());
}
