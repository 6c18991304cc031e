// SPDX-License-Identifier: Apache-2.0
// Where the figures come from, and how to get them again.
#include "report_html.h"

#include "report_markup.h"
#include "report_read.h"

static void print_hashes(FILE *stream, const json_t *document) {
  size_t i, k;
  const json_t *entry, *player;
  fputs("<div class=wide><table><thead><tr><th>Scenario<th>Bicycle's numbers (SHA-256)<th>Model "
        "(SHA-256)</tr></thead><tbody>\n",
        stream);
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    report_markup(stream, "<tr><td>%s<td class=hash>%s<td class=hash>", report_text(entry, "name"),
                  report_text(entry, "parameter_sha256"));
    json_array_foreach(json_object_get(entry, "engines"), k, player) {
      if (*report_text(player, "model_sha256"))
        report_markup(stream, "%s %s ", report_text(player, "label"),
                      report_text(player, "model_sha256"));
    }
    fputs("</tr>\n", stream);
  }
  fputs("</tbody></table></div>\n", stream);
}

static void print_timings(FILE *stream, const json_t *origin) {
  size_t i;
  const json_t *ride;
  const json_t *timings = json_object_get(origin, "timings");
  char elapsed[REPORT_NUMBER];
  report_markup(stream, "<details><summary>Timings: %s in all</summary>\n<ul>\n",
                report_quantity(elapsed, report_real(timings, "elapsed"), "s"));
  json_array_foreach(json_object_get(timings, "rides"), i, ride) {
    const char *key;
    json_t *value;
    report_markup(stream, "<li>%s:", report_text(ride, "scenario"));
    json_object_foreach((json_t *)ride, key, value) {
      char seconds[REPORT_NUMBER];
      if (json_is_real(value))
        report_markup(stream, " %s %s", key, report_quantity(seconds, json_real_value(value), "s"));
    }
    fputs("</li>\n", stream);
  }
  fputs("</ul></details>\n", stream);
}

void report_html_provenance(FILE *stream, const json_t *document) {
  const json_t *origin = json_object_get(document, "provenance");
  report_markup(stream,
                "<section class=provenance>\n<h2>Provenance</h2>\n<dl class=setup>\n<dt>To repeat"
                "<dd><code>%s</code>\n<dt>Made<dd>%s\n<dt>Program<dd>bicycle %s, schema %s\n"
                "<dt>Compiler<dd>%s\n<dt>CPU<dd>%s\n<dt>Signs<dd>%s: lean right, steer, yaw and y "
                "left positive\n</dl>\n",
                report_text(origin, "command"), report_text(origin, "created"),
                report_text(origin, "project"), report_text(document, "schema"),
                report_text(origin, "compiler"), report_text(origin, "cpu"),
                report_text(origin, "convention"));
  print_hashes(stream, document);
  print_timings(stream, origin);
  fputs("<p>Plots with scripts: dygraphs, MIT licence, embedded. Everything on this page is a view "
        "of <a id=/json href='report.json'>report.json</a>.</p>\n</section>\n",
        stream);
}
