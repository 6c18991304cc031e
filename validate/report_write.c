// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include "folder.h"
#include "report_views.h"
#include "terminal/message.h"

void report_file_names(char out[REPORT_FILES_PER_SCENARIO][REPORT_FILE_NAME], const comparison *c) {
  const char *const what[REPORT_FILES_PER_SCENARIO] = {c->side[REFERENCE].label,
                                                       c->side[CANDIDATE].label, "residuals"};
  for (int i = 0; i < REPORT_FILES_PER_SCENARIO; i++)
    snprintf(out[i], REPORT_FILE_NAME, "%s-%s.csv", c->scenario->name, what[i]);
}

static void write_csv(const comparison *c, int which, FILE *stream) {
  if (which < 2)
    report_trace_csv(&c->side[which].trace, stream);
  else
    report_residual_csv(c, stream);
}

static term_exit write_scenario(const folder *f, const comparison *c, problem *p) {
  char names[REPORT_FILES_PER_SCENARIO][REPORT_FILE_NAME];
  term_exit code = TERM_DONE;
  report_file_names(names, c);
  for (int i = 0; i < REPORT_FILES_PER_SCENARIO && code == TERM_DONE; i++) {
    FILE *stream;
    code = folder_open(&stream, f, names[i], p);
    if (code != TERM_DONE) return code;
    write_csv(c, i, stream);
    code = folder_close(stream, names[i], p);
  }
  return code;
}

static bool write_json(const report *r, const json_t *document, FILE *stream) {
  (void)r;
  // 17 significant digits identify every double.
  return json_dumpf(document, stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) == 0 &&
         fputc('\n', stream) != EOF;
}

static const struct {
  const char *name;
  report_view *write;
} views[REPORT_VIEWS] = {{"report.json", write_json},
                         {"report.html", report_html},
                         {"junit.xml", report_junit},
                         {"summary.md", report_summary}};

const char *report_view_name(int index) {
  return views[index].name;
}

static term_exit write_view(const folder *f, const report *r, const json_t *document, int index,
                            problem *p) {
  const char *name = views[index].name;
  FILE *stream;
  term_exit code = folder_open(&stream, f, name, p);
  if (code != TERM_DONE) return code;
  bool whole = views[index].write(r, document, stream) && !term_has_lost();
  bool written = whole || ferror(stream);
  code = folder_close(stream, name, p);
  return code != TERM_DONE || written ? code : problem_memory(p);
}

// Said only where the signal that waits is caught by somebody: it ends the program otherwise.
static term_exit interrupted(problem *p) {
  return problem_set(p, TERM_INVALID, "interrupted");
}

term_exit report_write(const report *r, const json_t *document, const char *path, problem *p) {
  folder f;
  term_exit code = folder_begin(&f, path, p);
  if (code != TERM_DONE) return code;
  for (size_t i = 0; i < r->count && code == TERM_DONE; i++)
    code = term_signal_waits() ? interrupted(p) : write_scenario(&f, &r->comparisons[i], p);
  for (int i = 0; i < REPORT_VIEWS && code == TERM_DONE; i++)
    code = term_signal_waits() ? interrupted(p) : write_view(&f, r, document, i, p);
  if (code == TERM_DONE) return folder_commit(&f, p);
  folder_abort(&f);
  return problem_prefix(p, code, path);
}
