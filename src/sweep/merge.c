// SPDX-License-Identifier: Apache-2.0
#include "merge.h"

#include "files/message.h"

#include <bicycle/error.h>
#include <bicycle/output.h>
#include <stdlib.h>
#include <string.h>

typedef struct merge {
  sweep_log_view *views; // of `count` logs
  int count;
  const char **rows; // by point: its record in one of the views, or NULL
} merge;

// ---- reading ----

static int check_header(const sweep_log_view *view, const sweep_log_view *first,
                        bike_file_error *error) {
  char what[BIKE_MESSAGE_SIZE];
  if (view->header_size == 0)
    return bike_message(error, BIKE_ERROR_SYNTAX, "%s: %s", view->path,
                        sweep_log_objection(what, view));
  if (view->header_size == first->header_size &&
      memcmp(view->data, first->data, view->header_size) == 0)
    return BIKE_OK;
  return bike_message(error, BIKE_ERROR_SYNTAX,
                      "%s: is of another sweep (spec, bicycle or version) than %s", view->path,
                      first->path);
}

static int map_all(merge *m, const char *const *paths, bike_file_error *error) {
  for (int i = 0; i < m->count; i++) {
    int code = sweep_log_map(&m->views[i], paths[i], error);
    if (!code) code = check_header(&m->views[i], &m->views[0], error);
    if (code) return code;
  }
  return BIKE_OK;
}

static const char *owner(const merge *m, const char *row) {
  for (int i = 0; i < m->count; i++)
    if (row >= m->views[i].data && row < m->views[i].data + m->views[i].size)
      return m->views[i].path;
  return "";
}

static void take(sweep_merged *out, const merge *m, const sweep_log_view *view,
                 const sweep_record *record) {
  const char *known = m->rows[record->index];
  if (!known) {
    m->rows[record->index] = record->text;
    out->present++;
    out->failed += record->failed;
  } else if (strncmp(known, record->text, record->size + 1) == 0) { // with the comma before the sum
    out->repeated++;
  } else if (out->contradictory++ == 0) {
    snprintf(out->conflict, sizeof out->conflict, "point %ld differs between %.400s and %.400s",
             record->index, owner(m, known), view->path);
  }
}

static void read_all(sweep_merged *out, const merge *m) {
  for (int i = 0; i < m->count; i++) {
    size_t place = 0;
    sweep_record record;
    while (sweep_log_next(&m->views[i], &place, &record)) take(out, m, &m->views[i], &record);
    out->damaged += m->views[i].damaged;
  }
}

// ---- what is missing ----

static void print_gap(char gaps[SWEEP_GAPS_SIZE], long first, long last, bool more) {
  const size_t used = strlen(gaps);
  char *end = gaps + used;
  const size_t room = SWEEP_GAPS_SIZE - used;
  const char *comma = used ? ", " : "";
  if (more)
    snprintf(end, room, "%s...", comma);
  else if (first == last)
    snprintf(end, room, "%s%ld", comma, first);
  else
    snprintf(end, room, "%s%ld-%ld", comma, first, last);
}

static void find_gaps(sweep_merged *out, const merge *m) {
  int shown = 0;
  for (long k = 0; k < out->points && shown <= SWEEP_GAPS_SHOWN; k++) {
    if (m->rows[k]) continue;
    const long first = k;
    while (k + 1 < out->points && !m->rows[k + 1]) k++;
    print_gap(out->gaps, first, k, shown++ == SWEEP_GAPS_SHOWN);
  }
}

// ---- writing ----

// The table is renamed into its place, so that it would replace a log of the same name.
static int check_output(const merge *m, const char *output, bike_file_error *error) {
  for (int i = 0; i < m->count; i++)
    if (sweep_log_is(&m->views[i], output))
      return bike_message(error, BIKE_ERROR_ARGUMENT,
                          "%s: is one of the logs: the table would replace it", output);
  return BIKE_OK;
}

static int write_table(const sweep_merged *merged, const merge *m, const char *path,
                       bike_file_error *error) {
  bike_output output;
  const int code = bike_output_begin(&output, path, error);
  if (code) return code;
  const char *columns = m->views[0].columns;
  fwrite(columns, 1, strcspn(columns, "\n") + 1, output.stream);
  for (long k = 0; k < merged->points; k++) {
    if (!m->rows[k]) continue;
    sweep_record record;
    sweep_parse_record(&record, m->rows[k], strcspn(m->rows[k], "\n"));
    fwrite(record.text, 1, record.size, output.stream);
    fputc('\n', output.stream);
  }
  return bike_output_commit(&output, error);
}

bool sweep_is_whole(const sweep_merged *merged) {
  return merged->present == merged->points && merged->contradictory == 0;
}

static int merge_all(sweep_merged *out, merge *m, const char *const *paths, const char *output,
                     bool partial, bike_file_error *error) {
  int code = map_all(m, paths, error);
  if (!code && output) code = check_output(m, output, error);
  if (code) return code;
  out->points = m->views[0].points;
  m->rows = calloc((size_t)out->points, sizeof *m->rows);
  if (!m->rows) return bike_message(error, BIKE_ERROR_MEMORY, "out of memory");
  read_all(out, m);
  find_gaps(out, m);
  const bool may = sweep_is_whole(out) || (partial && out->contradictory == 0);
  return output && may ? write_table(out, m, output, error) : BIKE_OK;
}

int sweep_merge(sweep_merged *out, const char *const *paths, int count, const char *output,
                bool partial, bike_file_error *error) {
  *out = (sweep_merged){0};
  merge m = {.count = count, .views = calloc((size_t)count, sizeof *m.views)};
  if (!m.views) return bike_message(error, BIKE_ERROR_MEMORY, "out of memory");
  const int code = merge_all(out, &m, paths, output, partial, error);
  for (int i = 0; i < count; i++) sweep_log_unmap(&m.views[i]);
  free(m.views);
  free(m.rows);
  return code;
}
