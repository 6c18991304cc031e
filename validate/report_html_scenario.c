// SPDX-License-Identifier: Apache-2.0
// One scenario in report.html.
#include "report_html.h"

#include "layer.h"
#include "report_curves.h"
#include "report_html_tree.h"
#include "report_markup.h"
#include "report_read.h"

#include <math.h>
#include <string.h>

static void print_title(FILE *stream, const json_t *s) {
  const layer *l = layer_find(report_text(s, "first_failure"));
  report_markup(stream, "<h2><span class='badge %s'>%s</span> %s</h2>\n<p>%s.</p>\n",
                report_text(s, "verdict"), report_text(s, "verdict"), report_text(s, "name"),
                report_text(s, "title"));
  if (!report_passed(s))
    report_markup(stream, "<p class=cause>%s %s: %s</p>\n", l ? l->name : "", l ? l->title : "",
                  report_text(s, "cause"));
}

// What differs from standing upright and straight: "speed 4 m/s, lean_rate 0.05 rad/s".
static void print_start(FILE *stream, const json_t *start) {
  static const struct {
    const char *key, *name, *unit;
  } members[] = {{"speed", "speed", "m/s"},
                 {"lean", "lean", "rad"},
                 {"steer", "steer", "rad"},
                 {"lean_rate", "lean rate", "rad/s"},
                 {"steer_rate", "steer rate", "rad/s"}};
  const char *separator = "";
  for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
    char value[REPORT_NUMBER];
    double number = report_real(start, members[i].key);
    if (number == 0 && i > 0) continue;
    report_markup(stream, "%s%s %s", separator, members[i].name,
                  report_quantity(value, number, members[i].unit));
    separator = ", ";
  }
}

// What acts on the bicycle; nothing where it rides hands off.
static void print_input(FILE *stream, const json_t *input) {
  char steer[REPORT_NUMBER], roll[REPORT_NUMBER];
  if (!input) return;
  if (json_object_get(input, "file"))
    report_markup(stream, "<dt>Input<dd>%s", report_text(input, "file"));
  else
    report_markup(stream, "<dt>Input<dd>steer torque %s, roll torque %s",
                  report_quantity(steer, report_real(input, "steer_torque"), "N m"),
                  report_quantity(roll, report_real(input, "roll_torque"), "N m"));
}

// "analytic: rk8, rtol 1e-13, atol 1e-13, step 0.001; libbicycle 0.1.0; 1037 steps"
static void print_engine(FILE *stream, const json_t *player, const char *role) {
  const char *key;
  json_t *value;
  char number[REPORT_NUMBER];
  report_markup(stream, "<dt class='%s'>%s<dd><b>%s</b>",
                strcmp(role, "Reference") == 0 ? "ref" : "cand", role,
                report_text(player, "label"));
  json_object_foreach(json_object_get(player, "options"), key, value) {
    const char *text = json_string_value(value);
    report_markup(stream, ", %s %s", key,
                  text ? text : report_number(number, json_number_value(value)));
  }
  report_markup(stream, "; %s", report_text(player, "version"));
  if (report_real(player, "steps") > 0)
    fprintf(stream, "; %.0f steps", report_real(player, "steps"));
  if (*report_text(player, "ended_by"))
    report_markup(stream, "; ended at %s: %s",
                  report_quantity(number, report_real(player, "end_time"), "s"),
                  report_text(player, "ended_by"));
}

static void print_setup(FILE *stream, const json_t *s) {
  const json_t *setup = json_object_get(s, "setup");
  char text[REPORT_NUMBER];
  report_markup(stream, "<dl class=setup>\n<dt>Bicycle<dd>%s", report_text(s, "bicycle"));
  fputs("<dt>Start<dd>", stream);
  print_start(stream, json_object_get(setup, "start"));
  print_input(stream, json_object_get(setup, "input"));
  report_markup(stream, "<dt>Length<dd>%s",
                report_quantity(text, report_real(setup, "duration"), "s"));
  report_markup(stream, ", a row every %s",
                report_quantity(text, report_real(setup, "sample"), "s"));
  double growth = report_real(setup, "growth_rate");
  if (growth > 0)
    report_markup(stream, "<dt>Growth<dd>%s of any difference allowed",
                  report_quantity(text, growth, "1/s"));
  print_engine(stream, report_engine(s, "reference"), "Reference");
  print_engine(stream, report_engine(s, "candidate"), "Candidate");
  fputs("\n</dl>\n", stream);
}

static bool print_pictures(FILE *stream, const comparison *c, const json_t *s) {
  bool done = true;
  if (c->side[REFERENCE].trace.count > 1 && c->side[CANDIDATE].trace.count > 1) {
    report_markup(stream,
                  "<div class=static>\n<p class=legend><span class=ref>%s</span> <span "
                  "class=cand>%s</span> <span class=limit>limit</span> <span "
                  "class=floor>rounding</span></p>\n<div class=plots>\n",
                  c->side[REFERENCE].label, c->side[CANDIDATE].label);
    done = report_curves(stream, c, s);
    fputs("</div>\n</div>\n<div class=live hidden></div>\n", stream);
  } else {
    fputs("<p class=dim>There is no ride to show.</p>\n", stream);
  }
  report_curves_convergence(stream, s);
  report_curves_cost(stream, c, s);
  return done;
}

// Studies without a picture of their own.
static void print_studies(FILE *stream, const json_t *s) {
  static const struct {
    const char *key, *title;
  } studies[] = {{"convergence", "Convergence: all numbers"},
                 {"linear", "Linear: eigenvalues and critical speeds"},
                 {"horizon", "Horizon: how far the ride can be predicted"},
                 {"cost", "Cost: all numbers"}};
  for (size_t i = 0; i < sizeof studies / sizeof *studies; i++) {
    const json_t *block = json_object_get(s, studies[i].key);
    if (!block || json_is_null(block)) continue;
    report_markup(stream, "<details><summary>%s</summary>\n", studies[i].title);
    report_html_tree(stream, block);
    fputs("</details>\n", stream);
  }
}

static void print_information(FILE *stream, const json_t *s) {
  size_t i;
  const json_t *m;
  char value[REPORT_NUMBER], time[REPORT_NUMBER], metric[MEASUREMENT_METRIC];
  fprintf(stream,
          "<details><summary>Measured without a limit (%zu)</summary>\n<div class=wide><table "
          "class=sortable><thead><tr><th>Layer<th>Signal<th>Metric<th>Value<th>At<th>Seen</tr>"
          "</thead><tbody>\n",
          report_count(s, "information"));
  json_array_foreach(json_object_get(s, "information"), i, m) {
    report_markup(stream, "<tr><td>%s<td>%s<td>%s<td class=r>%s", report_text(m, "layer"),
                  report_text(m, "signal"), report_metric(metric, m),
                  report_quantity(value, report_real(m, "value"), report_text(m, "unit")));
    double at = report_real(m, "time");
    report_markup(stream, "<td class=r>%s<td class=dim>%s</tr>\n",
                  isnan(at) ? "" : report_quantity(time, at, "s"), report_text(m, "detail"));
  }
  fputs("</tbody></table></div></details>\n", stream);
}

static void print_files(FILE *stream, const json_t *s) {
  size_t i;
  const json_t *name;
  fputs("<p class=files>Full precision, beside this page:", stream);
  json_array_foreach(json_object_get(s, "files"), i, name) {
    const char *text = json_string_value(name);
    if (text) report_markup(stream, "%s <a href='%u'>%s</a>", i ? "," : "", text, text);
  }
  fputs("</p>\n", stream);
}

bool report_html_scenario(FILE *stream, const comparison *c, const json_t *s,
                          report_reasons *reasons) {
  report_markup(stream, "<section class=scenario id='%s'>\n", report_text(s, "name"));
  print_title(stream, s);
  print_setup(stream, s);
  bool done = print_pictures(stream, c, s) && report_html_gates(stream, s, reasons);
  print_information(stream, s);
  print_studies(stream, s);
  print_files(stream, s);
  fputs("</section>\n", stream);
  return done;
}
