// SPDX-License-Identifier: Apache-2.0
#include "report_html.h"

#include "report_markup.h"
#include "report_pack.h"
#include "report_read.h"
#include "report_web.h"

#include <stdlib.h>
#include <string.h>

// The value of one hexadecimal digit.
static unsigned digit(char c) {
  return (unsigned)(c <= '9' ? c - '0' : c - 'a' + 10);
}

// 'sha256-...' of a script, as Content-Security-Policy names those that may run.
static void print_script_hash(FILE *stream, const char *script) {
  char hex[SHA256_HEX_SIZE];
  unsigned char bytes[(SHA256_HEX_SIZE - 1) / 2];
  sha256_hex(hex, script, strlen(script));
  for (size_t i = 0; i < sizeof bytes; i++)
    bytes[i] = (unsigned char)(digit(hex[2 * i]) << 4 | digit(hex[2 * i + 1]));
  fputs("'sha256-", stream);
  report_base64(stream, bytes, sizeof bytes);
  fputc('\'', stream);
}

// Nothing may be requested from anywhere, and no script runs but the two of this program. Styles
// are the page's own and those dygraphs sets: without a request they do no harm.
static void print_head(FILE *stream, const json_t *document) {
  fputs("<!DOCTYPE html>\n<html lang=en>\n<head>\n<meta charset=utf-8>\n"
        "<meta http-equiv=Content-Security-Policy content=\"default-src 'none'; "
        "style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'; script-src ",
        stream);
  print_script_hash(stream, report_web_dygraphs);
  fputc(' ', stream);
  print_script_hash(stream, report_web_script);
  fputs("\">\n<meta name=viewport content='width=device-width, initial-scale=1'>\n"
        "<meta name=color-scheme content='light dark'>\n",
        stream);
  report_markup(stream, "<title>%s: bicycle comparison</title>\n<style>\n",
                report_text(document, "verdict"));
  fputs(report_web_style, stream);
  fputs("</style>\n</head>\n<body>\n", stream);
}

static bool print_data(FILE *stream, const report *r, const json_t *document) {
  size_t stride = report_pack_stride(r);
  bool done = true;
  for (size_t i = 0; i < r->count && done; i++) {
    const comparison *c = &r->comparisons[i];
    if (c->side[REFERENCE].trace.count == 0) continue;
    report_markup(stream, "<script type='application/json' data-scenario='%s'>", c->scenario->name);
    done = report_pack(stream, c, stride);
    fputs("</script>\n", stream);
  }
  char *text = done ? json_dumps(document, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) : NULL;
  if (!text) return false;
  fputs("<script type='text/plain' id=/report-json>", stream);
  done = report_pack_text(stream, text);
  fputs("</script>\n", stream);
  free(text);
  return done;
}

static void print_scripts(FILE *stream) {
  const char *const scripts[] = {report_web_dygraphs, report_web_script};
  for (int i = 0; i < 2; i++) {
    fputs("<script>", stream);
    fputs(scripts[i], stream);
    fputs("</script>\n", stream);
  }
}

bool report_html(const report *r, const json_t *document, FILE *stream) {
  report_reasons reasons = {0};
  const json_t *scenarios = json_object_get(document, "scenarios");
  print_head(stream, document);
  report_html_verdict(stream, document);
  report_html_overview(stream, document);
  bool done = true;
  fputs("<main>\n", stream);
  for (size_t i = 0; i < r->count && done; i++)
    done = report_html_scenario(stream, &r->comparisons[i], json_array_get(scenarios, i), &reasons);
  fputs("</main>\n", stream);
  report_html_reasons(stream, &reasons);
  report_html_provenance(stream, document);
  done = done && print_data(stream, r, document);
  print_scripts(stream);
  fputs("</body>\n</html>\n", stream);
  free(reasons.items);
  return done;
}
