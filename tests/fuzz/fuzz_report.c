// SPDX-License-Identifier: Apache-2.0
// Saved reports, made from the schema: an earlier one and a later one, which is another or the same
// with changes. They are read, compared, and shown in every view.
#include "fuzz.h"

#include "baseline.h"
#include "report_read.h"
#include "report_views.h"
#include "schema_document.h"

#include <math.h>
#include <string.h>

// Switches of the first byte. Only one input in eight makes a page: its digests of the scripts take
// more time than all the rest.
enum { STRAYS = 1, ANOTHER = 2, PAGE = 4 + 8 + 16 };

static json_t *load_schema(void) {
  json_error_t error;
  json_t *schema =
      json_load_file(BICYCLE_SOURCE_DIR "/validate/schema/report.schema.json", 0, &error);
  FUZZ_REQUIRE(schema, "%s", error.text);
  return schema;
}

// Names that compare looks up; the schema allows several scenarios of one name.
static void number_scenarios(json_t *document) {
  size_t i;
  json_t *entry;
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    const char *name = json_string_value(json_object_get(entry, "name"));
    if (name) json_object_set_new(entry, "name", json_sprintf("%.60s%zu", name, i));
  }
}

static json_t *one_of(json_t *array, fuzz_bytes *bytes, size_t *index) {
  size_t count = json_array_size(array);
  *index = count ? fuzz_below(bytes, (unsigned)count) : 0;
  return json_array_get(array, *index);
}

// A change that keeps the rides comparable: a gate with another value, or one less, a scenario
// less.
static void change(json_t *document, fuzz_bytes *bytes) {
  size_t i, k;
  json_t *scenarios = json_object_get(document, "scenarios");
  json_t *entry = one_of(scenarios, bytes, &i);
  json_t *gates = json_object_get(entry, "gates"), *judged = one_of(gates, bytes, &k);
  double value = fuzz_number(bytes);
  switch (fuzz_below(bytes, 4)) {
  case 0:
    json_array_remove(scenarios, i);
    break;
  case 1:
    json_array_remove(gates, k);
    break;
  case 2:
    json_object_set_new(judged, "value", isfinite(value) ? json_real(value) : json_null());
    break;
  default:
    json_object_set_new(judged, "pass", json_boolean(value > 0));
  }
}

static json_t *read_back(const json_t *document, const char *name) {
  json_t *out = NULL;
  problem p = {""};
  char *text = json_dumps(document, JSON_REAL_PRECISION(17));
  if (!text) return NULL;
  const char *path = fuzz_write(name, text, strlen(text));
  free(text);
  if (baseline_read(&out, path, &p) == TERM_DONE) return out;
  FUZZ_REQUIRE(!out && fuzz_one_line(p.text), "'%s'", p.text);
  return NULL;
}

// XML 1.0 has no control characters but these three.
static void require_xml(const char *text) {
  for (; *text; text++)
    FUZZ_REQUIRE((unsigned char)*text >= 0x20 || strchr("\t\n\r", *text), "byte %d", *text);
}

static void show(const json_t *document, bool page) {
  const report nothing = {0};
  char *text = NULL;
  size_t size = 0;
  FILE *stream = open_memstream(&text, &size);
  FUZZ_REQUIRE(report_junit(&nothing, document, stream), "memory");
  fflush(stream);
  require_xml(text);
  report_print(document, true, stream);
  report_print(document, false, stream);
  baseline_print(document, stream);
  FUZZ_REQUIRE(report_summary(&nothing, document, stream), "memory");
  if (page) FUZZ_REQUIRE(report_html(&nothing, document, stream), "memory");
  fclose(stream);
  free(text);
}

// Whether each scenario of `a` has its like in `b`, by name.
static bool all_there(const json_t *a, const json_t *b) {
  size_t i, k;
  const json_t *x, *y;
  json_array_foreach(json_object_get(a, "scenarios"), i, x) {
    bool there = false;
    json_array_foreach(json_object_get(b, "scenarios"), k, y) {
      there |= strcmp(report_text(x, "name"), report_text(y, "name")) == 0;
    }
    if (!there) return false;
  }
  return true;
}

static void compare(json_t *now, const json_t *before, bool same) {
  problem p = {""};
  term_exit code = baseline_match(now, before, &p);
  if (code != TERM_DONE) {
    FUZZ_REQUIRE(fuzz_one_line(p.text), "'%s'", p.text);
    return;
  }
  FUZZ_REQUIRE(baseline_compare(now, before), "memory");
  if (!all_there(before, now)) FUZZ_REQUIRE(baseline_is_worse(now), "scenarios are gone");
  if (same) FUZZ_REQUIRE(report_real(json_object_get(now, "baseline"), "gone") == 0, "same");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static json_t *schema;
  fuzz_bytes bytes = {data, size};
  if (!schema) schema = load_schema();
  const unsigned switches = fuzz_byte(&bytes);
  json_t *a = schema_document(schema, &bytes, switches & STRAYS), *b;
  number_scenarios(a);
  if (switches & ANOTHER) {
    b = schema_document(schema, &bytes, switches & STRAYS);
    number_scenarios(b);
  } else {
    b = json_deep_copy(a);
    if (bytes.left > 0) change(b, &bytes);
  }
  json_t *before = read_back(a, "a.json"), *now = read_back(b, "b.json");
  if (before && now) compare(now, before, json_equal(a, b));
  if (now) show(now, (switches & PAGE) == PAGE);
  json_decref(a);
  json_decref(b);
  json_decref(before);
  json_decref(now);
  return 0;
}
