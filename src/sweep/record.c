// SPDX-License-Identifier: Apache-2.0
#include "record.h"

#include "files/number.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
  SUM_SIZE = 9,        // ",xxxxxxxx"
  REASONS_SIZE = 1024, // of four questions at most, of less than 200 each
  LARGEST_ROW = 16384  // 70 numbers, ranges and reasons: 4 KiB
};

// RFC 4180; a record is one line whatever a name or a reason holds.
static void print_text(FILE *stream, const char *text) {
  const bool quoted = strpbrk(text, ",\"\r\n") != NULL;
  if (quoted) fputc('"', stream);
  for (; *text; text++) {
    if (*text == '"') fputc('"', stream);
    fputc((unsigned char)*text < 0x20 ? '?' : *text, stream);
  }
  if (quoted) fputc('"', stream);
}

static void print_number(FILE *stream, double value) {
  char text[BIKE_NUMBER_SIZE];
  if (isnan(value)) return; // an empty field
  bike_number_print(text, value);
  fputs(text, stream);
}

void sweep_print_columns(FILE *stream, const sweep_spec *spec) {
  fputs("index", stream);
  for (int i = 0; i < spec->axis_count; i++) {
    fputc(',', stream);
    print_text(stream, spec->axes[i].name);
  }
  for (int i = 0; i < spec->output_count; i++)
    fprintf(stream, ",%s", sweep_output_name(spec->outputs[i]));
  fputs(",error", stream);
}

static void print_output(FILE *stream, const sweep_row *row, sweep_output output) {
  fputc(',', stream);
  if (output == SWEEP_OUTCOME)
    fputs(row->outcome, stream);
  else if (output == SWEEP_STABLE_RANGES)
    fputs(row->ranges, stream);
  else
    print_number(stream, row->numbers[output]);
}

bool sweep_row_failed(const sweep_row *row, const sweep_spec *spec) {
  bool failed = row->error[0] != '\0';
  for (int i = 0; i < spec->output_count; i++) failed |= row->codes[spec->outputs[i]] != BIKE_OK;
  return failed;
}

// Adds to a text that has room.
static void add(char out[REASONS_SIZE], const char *before, const char *text) {
  const size_t used = strlen(out);
  snprintf(out + used, REASONS_SIZE - used, "%s%s", before, text);
}

// "NAME NAME: reason; NAME: another" of the outputs that failed.
static void collect_reasons(char out[REASONS_SIZE], const sweep_row *row, const sweep_spec *spec) {
  unsigned told = 0; // bit: an output of the spec
  out[0] = '\0';
  for (int i = 0; i < spec->output_count; i++) {
    const int code = row->codes[spec->outputs[i]];
    const char *before = out[0] ? "; " : "";
    if (code == BIKE_OK || told >> i & 1U) continue;
    for (int k = i; k < spec->output_count; k++) {
      if (row->codes[spec->outputs[k]] != code) continue;
      add(out, before, sweep_output_name(spec->outputs[k]));
      told |= 1U << k;
      before = " ";
    }
    add(out, ": ", bike_error_string(code));
  }
}

static void print_row(FILE *stream, const sweep_row *row, const sweep_spec *spec) {
  fprintf(stream, "%ld", row->index);
  for (int i = 0; i < spec->axis_count; i++) {
    fputc(',', stream);
    print_number(stream, row->values[i]);
  }
  for (int i = 0; i < spec->output_count; i++) print_output(stream, row, spec->outputs[i]);
  char reasons[REASONS_SIZE];
  collect_reasons(reasons, row, spec);
  fputc(',', stream);
  print_text(stream, row->error[0] ? row->error : reasons);
}

static unsigned long sum_of(const char *text, size_t size) {
  return crc32(crc32(0, NULL, 0), (const Bytef *)text, (uInt)size);
}

bool sweep_print_record(FILE *stream, const sweep_row *row, const sweep_spec *spec) {
  char text[LARGEST_ROW];
  FILE *line = fmemopen(text, sizeof text, "w");
  if (!line) return false;
  print_row(line, row, spec);
  const long size = ftell(line);
  if (fclose(line) != 0 || size <= 0 || size >= LARGEST_ROW) return false;
  fwrite(text, 1, (size_t)size, stream);
  fprintf(stream, ",%08lx\n", sum_of(text, (size_t)size));
  return true;
}

bool sweep_parse_record(sweep_record *out, const char *line, size_t size) {
  if (size <= SUM_SIZE + 1 || line[size - SUM_SIZE] != ',') return false;
  char digits[SUM_SIZE], *end;
  memcpy(digits, line + size - SUM_SIZE + 1, SUM_SIZE - 1);
  digits[SUM_SIZE - 1] = '\0';
  if (strspn(digits, "0123456789abcdef") != SUM_SIZE - 1) return false;
  size -= SUM_SIZE;
  if (strtoul(digits, NULL, 16) != sum_of(line, size)) return false;
  *out = (sweep_record){.text = line, .size = size, .failed = line[size - 1] != ','};
  out->index = strtol(line, &end, 10); // the sum is right: what stands there was written by us
  return end > line && *end == ',';
}
