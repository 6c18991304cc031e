// SPDX-License-Identifier: Apache-2.0
// Runs a target once over each file of the folders given: what libFuzzer does with a corpus, in a
// build without it.
#include "fuzz.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>

static void run_file(const char *path) {
  static uint8_t bytes[1 << 20];
  FILE *stream = fopen(path, "rbe");
  FUZZ_REQUIRE(stream, "%s", path);
  size_t size = fread(bytes, 1, sizeof bytes, stream);
  fclose(stream);
  uint8_t *exact = malloc(size ? size : 1); // so that a read beyond the end is seen
  FUZZ_REQUIRE(exact, "%zu bytes", size);
  memcpy(exact, bytes, size);
  fprintf(stderr, "%s\n", path); // the last one is to blame
  LLVMFuzzerTestOneInput(exact, size);
  free(exact);
}

static long run_folder(const char *folder) {
  long count = 0;
  DIR *entries = opendir(folder);
  FUZZ_REQUIRE(entries, "%s: %s", folder, strerror(errno));
  for (const struct dirent *entry; (entry = readdir(entries));) {
    char path[4096];
    if (entry->d_name[0] == '.') continue;
    snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
    run_file(path);
    count++;
  }
  closedir(entries);
  return count;
}

int main(int argc, char **argv) {
  long count = 0;
  for (int i = 1; i < argc; i++) count += run_folder(argv[i]);
  printf("%ld inputs\n", count);
  FUZZ_REQUIRE(count > 0, "no inputs");
  return 0;
}
