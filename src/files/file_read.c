// SPDX-License-Identifier: Apache-2.0
// Which form a bicycle file has, and its bicycle.
#include "forms.h"
#include "message.h"
#include "source.h"
#include "text_form.h"

#include <bicycle/error.h>
#include <bicycle/file.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Bicycle files are a few kilobytes; this leaves room for long descriptions and bounds what a
// hostile file can cost (0.2 s and 100 MB within libfyaml).
static const size_t LARGEST_FILE = 256 * 1024;

// "model/roadster.yml" -> "roadster"
static void name_of_path(char name[BIKE_NAME_SIZE], const char *path) {
  const char *slash = strrchr(path, '/');
  const char *base = slash ? slash + 1 : path;
  const char *dot = strrchr(base, '.');
  const size_t length = dot && dot > base ? (size_t)(dot - base) : strlen(base);
  bike_text_name(name, BIKE_NAME_SIZE, base, length);
}

typedef int symbols_reader(bike_symbols *out, char name[BIKE_NAME_SIZE], const bike_yaml *yaml);

static int read_symbols(bike_file *out, bike_source *source, symbols_reader *read,
                        const bike_yaml *yaml) {
  char name[BIKE_NAME_SIZE];
  source->literature = true;
  int code = read(&source->symbols, name, yaml);
  if (!code) code = bike_symbols_to_file(out, &source->symbols, yaml->path, yaml->error);
  if (!code) memcpy(out->bicycle.name, name, sizeof name);
  return code;
}

static int read_form(bike_file *out, bike_source *source, const bike_yaml *yaml) {
  bike_field form;
  if (!bike_yaml_find(yaml->root, "parameterization", &form)) {
    if (!bike_yaml_find(yaml->root, "values", &form))
      return read_symbols(out, source, bike_read_flat_form, yaml);
    return bike_yaml_fail(yaml, &form, BIKE_ERROR_SYNTAX, "key 'parameterization' is missing");
  }
  if (bike_yaml_is_text(&form, "Meijaard2007") || bike_yaml_is_text(&form, "benchmark"))
    return read_symbols(out, source, bike_read_values_form, yaml);
  if (bike_yaml_is_text(&form, "components"))
    return bike_read_components(&out->bicycle, &source->description, yaml);
  if (bike_yaml_is_text(&form, "principal") || bike_yaml_is_text(&form, "Moore2019"))
    return bike_yaml_fail(yaml, &form, BIKE_ERROR_SYNTAX,
                          "principal (Moore2019) is not supported: convert it to Meijaard2007 "
                          "with BicycleParameters");
  return bike_yaml_fail(yaml, &form, BIKE_ERROR_SYNTAX,
                        "must be Meijaard2007, benchmark or components");
}

static int read_text(bike_file *out, bike_source *source, const bike_text *text, const char *path,
                     bike_file_error *error) {
  if (bike_is_text_form(text)) {
    source->literature = true;
    const int code = bike_read_text_form(&source->symbols, text, path, error);
    return code ? code : bike_symbols_to_file(out, &source->symbols, path, error);
  }
  bike_yaml yaml;
  int code = bike_yaml_open(&yaml, text, path, error);
  if (!code) code = read_form(out, source, &yaml);
  bike_yaml_close(&yaml);
  return code;
}

int bike_source_read(bike_file *out, bike_source *source, const char *path,
                     bike_file_error *error) {
  if (!out || !path) return bike_message(error, BIKE_ERROR_ARGUMENT, "no file is named");
  bike_text text;
  int code = bike_text_read(&text, path, LARGEST_FILE, error);
  if (code) return code;
  bike_file file = {0};
  code = read_text(&file, source, &text, path, error);
  bike_text_free(&text);
  if (code) return code;
  if (!file.bicycle.name[0]) name_of_path(file.bicycle.name, path);
  *out = file;
  return BIKE_OK;
}

int bike_file_read(bike_file *out, const char *path, bike_file_error *error) {
  bike_source *source = calloc(1, sizeof *source);
  if (!source) return bike_message(error, BIKE_ERROR_MEMORY, "out of memory");
  const int code = bike_source_read(out, source, path, error);
  free(source);
  return code;
}
