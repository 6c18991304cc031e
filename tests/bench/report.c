// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include "machine.h"
#include "terminal/json.h"
#include "terminal/table.h"

#include <math.h>

static const char *status_text(bench_status status) {
  switch (status) {
  case BENCH_MEASURED:
    return "measured";
  case BENCH_NOT_MEASURED:
    return "not measured";
  case BENCH_REFUSED:
    return "refused";
  }
  return "";
}

//---------------------------------- table ---------------------------------------------------------

static void put_time(char *out, size_t size, double seconds) {
  if (!isfinite(seconds))
    snprintf(out, size, "-");
  else if (seconds < 1e-6)
    snprintf(out, size, "%.3g ns", 1e9 * seconds);
  else if (seconds < 1e-3)
    snprintf(out, size, "%.3g us", 1e6 * seconds);
  else
    snprintf(out, size, "%.3g ms", 1e3 * seconds);
}

static void put_asked(char *out, size_t size, const bench_contest *c) {
  const char *sign = c->sense == BENCH_AT_LEAST ? ">=" : "<=";
  if (c->asked == 0)
    snprintf(out, size, "-");
  else if (c->possible == 0)
    snprintf(out, size, "%s %g", sign, c->asked);
  else
    snprintf(out, size, "%s %g (%g)", sign, c->asked, c->possible);
}

static void add_row(term_table *table, const bench_line *line) {
  const bench_contest *c = line->contest;
  const bench_result *r = &line->result;
  char ours[32], theirs[32], ratio[32] = "-", spread[48] = "-", asked[48];
  bool measured = r->status == BENCH_MEASURED, met = measured && bench_met(c, r);
  put_time(ours, sizeof ours, r->ours);
  put_time(theirs, sizeof theirs, r->theirs);
  put_asked(asked, sizeof asked, c);
  if (measured) {
    snprintf(ratio, sizeof ratio, "%.2f", r->ratio);
    snprintf(spread, sizeof spread, "%.2f .. %.2f%s", r->low, r->high,
             bench_noisy(r) ? " noisy" : "");
  }
  const char *verdict = !measured       ? status_text(r->status)
                        : c->asked == 0 ? "-"
                        : met           ? "yes"
                                        : "NO";
  const char *cells[] = {c->name, c->question, ours, theirs, ratio, spread, asked, verdict};
  term_table_add(table, met || !measured ? TERM_PLAIN : TERM_BAD, cells);
}

bool bench_print_table(const bench_line *lines, size_t count) {
  static const term_column COLUMNS[] = {
      {"name", TERM_LEFT},   {"contest", TERM_LEFT},   {"ours", TERM_RIGHT}, {"peer", TERM_RIGHT},
      {"ratio", TERM_RIGHT}, {"quartiles", TERM_LEFT}, {"asked", TERM_LEFT}, {"met?", TERM_LEFT}};
  term_table *table = term_table_create(COLUMNS, sizeof COLUMNS / sizeof COLUMNS[0]);
  for (size_t i = 0; i < count; i++) add_row(table, &lines[i]);
  char machine[512];
  bench_machine_line(machine, sizeof machine);
  printf("%s\n\n", machine);
  bool written = term_table_print(table, stdout);
  term_table_free(table);
  for (size_t i = 0; i < count; i++)
    if (lines[i].result.status != BENCH_MEASURED)
      printf("%s: %s: %s\n", lines[i].contest->name, status_text(lines[i].result.status),
             lines[i].result.notes.reason);
  return written;
}

//---------------------------------- JSON ----------------------------------------------------------

static json_t *notes_json(const bench_notes *notes, bool checks) {
  json_t *object = json_object();
  for (int i = 0; i < notes->count; i++) {
    const bench_note *n = &notes->list[i];
    if (isnan(n->limit) == checks) continue;
    json_t *value = term_json_number(n->value);
    if (checks)
      value = json_pack("{s:o, s:o}", "value", value, "limit", term_json_number(n->limit));
    json_object_set_new(object, n->name, value);
  }
  return object;
}

static json_t *side_json(const bench_runner *runner, double seconds) {
  return json_pack("{s:s, s:o}", "name", runner->name, "seconds", term_json_number(seconds));
}

static json_t *optional(double asked) {
  return asked == 0 ? json_null() : term_json_number(asked);
}

static json_t *line_json(const bench_line *line) {
  const bench_contest *c = line->contest;
  const bench_result *r = &line->result;
  bool measured = r->status == BENCH_MEASURED;
  json_t *met = measured && c->asked != 0 ? json_boolean(bench_met(c, r)) : json_null();
  json_t *object = json_pack(
      "{s:s, s:s, s:s, s:s, s:o, s:o, s:s, s:o, s:[o, o], s:b, s:i}", "name", c->name, "question",
      c->question, "status", status_text(r->status), "reason", r->notes.reason, "ours",
      side_json(&c->ours, r->ours), "theirs", side_json(&c->theirs, r->theirs), "ratio_is",
      c->sense == BENCH_AT_LEAST ? "theirs / ours" : "ours / theirs", "ratio",
      term_json_number(r->ratio), "quartiles", term_json_number(r->low), term_json_number(r->high),
      "noisy", measured && bench_noisy(r), "rounds", r->rounds);
  json_t *judged = json_pack("{s:o, s:o, s:o, s:o, s:o}", "asked", optional(c->asked), "possible",
                             optional(c->possible), "met", met, "checks",
                             notes_json(&r->notes, true), "notes", notes_json(&r->notes, false));
  json_object_update(object, judged);
  json_decref(judged);
  return object;
}

bool bench_print_json(const bench_line *lines, size_t count, const bench_subject *subject) {
  json_t *list = json_array();
  for (size_t i = 0; i < count; i++) json_array_append_new(list, line_json(&lines[i]));
  return term_json_write(json_pack("{s:o, s:s, s:b, s:o}", "machine", bench_machine(), "bicycle",
                                   subject->bicycle.name, "quick", subject->quick, "contests",
                                   list),
                         stdout);
}
