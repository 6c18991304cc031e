// SPDX-License-Identifier: Apache-2.0
// Logs of sweeps, one or two of them, read and merged. An input begins with a byte of switches:
// 1: records get the check sum that belongs to them; 2: a line "---" parts two logs.
#include "fuzz.h"

#include "sweep/merge.h"

#include <bicycle/error.h>
#include <string.h>
#include <zlib.h>

enum { SUMS = 1, TWO = 2, LARGEST = 1 << 16, MOST_POINTS = 100000 }; // a table of 8 bytes a point

// Copies lines; a record, which begins with a digit, gets the sum of what stands before its last
// comma.
static size_t with_sums(char out[2 * LARGEST], const char *text, size_t size) {
  size_t used = 0;
  while (size > 0) {
    const char *end = memchr(text, '\n', size);
    size_t length = end ? (size_t)(end - text) : size, whole = length + (end != NULL);
    memcpy(out + used, text, whole);
    const char *comma = length ? memrchr(text, ',', length) : NULL;
    if (comma && end && *text >= '0' && *text <= '9') {
      unsigned long sum = crc32(crc32(0, NULL, 0), (const Bytef *)text, (uInt)(comma - text));
      used += (size_t)(comma - text);
      used += (size_t)sprintf(out + used, ",%08lx\n", sum);
    } else {
      used += whole;
    }
    text += whole;
    size -= whole;
  }
  return used;
}

static void require_view(const char *path, long *points) {
  sweep_log_view view;
  sweep_record record;
  bike_file_error error = {""};
  size_t place = 0;
  *points = 0;
  if (sweep_log_map(&view, path, &error) != BIKE_OK) return;
  if (view.header_size > 0) {
    *points = view.points;
    while (sweep_log_next(&view, &place, &record)) {
      FUZZ_REQUIRE(record.index >= 0 && record.index < view.points, "record %ld", record.index);
      FUZZ_REQUIRE(record.text >= view.data && record.text + record.size <= view.data + view.size,
                   "record %ld", record.index);
    }
    FUZZ_REQUIRE(view.whole <= view.size, "%zu of %zu bytes", view.whole, view.size);
  }
  sweep_log_unmap(&view);
}

static void require_merge(const char *const *paths, int count) {
  sweep_merged m;
  bike_file_error error = {""};
  if (sweep_merge(&m, paths, count, NULL, true, &error) != BIKE_OK) {
    FUZZ_REQUIRE(fuzz_one_line(error.text), "'%s'", error.text);
    return;
  }
  FUZZ_REQUIRE(m.present >= 0 && m.present <= m.points, "%ld of %ld", m.present, m.points);
  FUZZ_REQUIRE(m.failed <= m.present, "%ld of %ld failed", m.failed, m.present);
  FUZZ_REQUIRE(!m.contradictory || fuzz_one_line(m.conflict), "'%s'", m.conflict);
  FUZZ_REQUIRE((m.present == m.points) == (m.gaps[0] == '\0'), "'%s'", m.gaps);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static char text[2 * LARGEST];
  const char *paths[2];
  long points[2] = {0};
  if (size == 0 || size > LARGEST) return 0;
  const int switches = *data;
  size_t length = size - 1;
  if (switches & SUMS)
    length = with_sums(text, (const char *)data + 1, length);
  else
    memcpy(text, data + 1, length);
  const char *cut = switches & TWO ? memmem(text, length, "---\n", 4) : NULL;
  size_t first = cut ? (size_t)(cut - text) : length;
  paths[0] = fuzz_write("1.log", text, first);
  if (cut) paths[1] = fuzz_write("2.log", cut + 4, length - first - 4);
  for (int i = 0; i < 1 + (cut != NULL); i++) require_view(paths[i], &points[i]);
  if (points[0] <= MOST_POINTS && points[1] <= MOST_POINTS) require_merge(paths, 1 + (cut != NULL));
  return 0;
}
