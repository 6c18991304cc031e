// SPDX-License-Identifier: Apache-2.0
#include "fuzz.h"

#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_FILES = 8, NAME_SIZE = 32, PATH_SIZE = 96 };

// Freed memory stays apart for a short while only: new pages for each input take the most time.
const char *__asan_default_options(void);
const char *__asan_default_options(void) {
  return "quarantine_size_mb=16";
}

static char folder[64];
static char names[MOST_FILES][NAME_SIZE], paths[MOST_FILES][PATH_SIZE];
static int file_count;

static void remove_folder(void) {
  for (int i = 0; i < file_count; i++) unlink(paths[i]);
  if (*folder) rmdir(folder);
}

void fuzz_abort(void) {
  remove_folder();
  abort();
}

static void make_folder(void) {
  snprintf(folder, sizeof folder, "%s/bicycle-fuzz.XXXXXX",
           access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
  FUZZ_REQUIRE(mkdtemp(folder), "%s", folder);
  atexit(remove_folder);
}

static const char *path_of(const char *name) {
  if (!*folder) make_folder();
  for (int i = 0; i < file_count; i++)
    if (strcmp(names[i], name) == 0) return paths[i];
  FUZZ_REQUIRE(file_count < MOST_FILES, "%s", name);
  snprintf(names[file_count], NAME_SIZE, "%s", name);
  snprintf(paths[file_count], PATH_SIZE, "%s/%s", folder, name);
  return paths[file_count++];
}

const char *fuzz_write(const char *name, const void *bytes, size_t size) {
  const char *path = path_of(name);
  int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  FUZZ_REQUIRE(descriptor >= 0, "%s", path);
  FUZZ_REQUIRE(write(descriptor, bytes, size) == (ssize_t)size, "%s", path);
  close(descriptor);
  return path;
}

const char *fuzz_copy(const char *name, const char *source) {
  static char bytes[1 << 20];
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", BICYCLE_SOURCE_DIR, source);
  FILE *stream = fopen(path, "rbe");
  FUZZ_REQUIRE(stream, "%s", path);
  size_t size = fread(bytes, 1, sizeof bytes, stream);
  fclose(stream);
  return fuzz_write(name, bytes, size);
}

bool fuzz_one_line(const char *text) {
  if (!*text) return false;
  for (; *text; text++)
    if ((unsigned char)*text < 0x20 || *text == 0x7f) return false;
  return true;
}

//---------------------------------- bytes as choices ----------------------------------------------

unsigned fuzz_byte(fuzz_bytes *bytes) {
  if (bytes->left == 0) return 0;
  bytes->left--;
  return *bytes->data++;
}

unsigned fuzz_below(fuzz_bytes *bytes, unsigned count) {
  unsigned choice = fuzz_byte(bytes);
  if (count > 256) choice = choice << 8 | fuzz_byte(bytes);
  return choice % count;
}

double fuzz_number(fuzz_bytes *bytes) {
  static const double special[] = {
      0,   -0.0, 1,    -1,    0.5,    -0.5,  1e-9,   -1e-9,  1e-6,   1e-3,     10,        100,
      1e3, 1e6,  1e15, 1e300, -1e300, 1e154, 1e-154, 1e-300, 5e-324, INFINITY, -INFINITY, NAN};
  unsigned kind = fuzz_byte(bytes);
  if (kind < 96) return special[kind % (sizeof special / sizeof *special)];
  if (kind < 250) { // 16 bits as an ordinary number
    int raw = (int)(fuzz_byte(bytes) << 8 | fuzz_byte(bytes)) - 0x8000;
    return raw / 4096.0;
  }
  uint64_t bits = 0;
  for (int i = 0; i < 8; i++) bits = bits << 8 | fuzz_byte(bytes);
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}
