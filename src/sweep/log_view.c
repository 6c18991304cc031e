// SPDX-License-Identifier: Apache-2.0
// Reading the log.
#include "log.h"

#include "files/message.h"

#include <bicycle/error.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static int map(sweep_log_view *out, int descriptor, bike_file_error *error) {
  struct stat status;
  if (fstat(descriptor, &status) != 0) return bike_message_system(error, out->path, errno);
  if (S_ISDIR(status.st_mode)) return bike_message_system(error, out->path, EISDIR);
  if (!S_ISREG(status.st_mode))
    return bike_message(error, BIKE_ERROR_FILE, "%s: is not a regular file", out->path);
  out->device = status.st_dev;
  out->file = status.st_ino;
  out->size = (size_t)status.st_size;
  out->data = "";
  if (out->size == 0) return BIKE_OK;
  void *data = mmap(NULL, out->size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  if (data == MAP_FAILED) return bike_message_system(error, out->path, errno);
  out->data = data;
  return BIKE_OK;
}

// The line that begins at `place`: its length without the line feed, or -1 where it is torn.
static long line_length(const sweep_log_view *view, size_t place) {
  const char *line = view->data + place;
  const char *end = place < view->size ? memchr(line, '\n', view->size - place) : NULL;
  return end ? end - line : -1;
}

// Five lines that begin with their key; leaves header_size at 0 where one is missing or wrong.
static void read_header(sweep_log_view *view) {
  static const char *const keys[] = {"# bicycle-sweep log ", "# version ", "# spec ", "# points ",
                                     "# columns "};
  size_t place = 0;
  for (int i = 0; i < 5; i++) {
    const long length = line_length(view, place);
    const size_t key = strlen(keys[i]);
    if (length < (long)key || memcmp(view->data + place, keys[i], key) != 0) return;
    if (i == 0) view->format = strtol(view->data + place + key, NULL, 10);
    if (view->format != SWEEP_LOG_FORMAT) return;
    if (i == 3) view->points = strtol(view->data + place + key, NULL, 10);
    if (i == 4) view->columns = view->data + place + key;
    place += (size_t)length + 1;
  }
  if (view->points >= 1 && view->points <= SWEEP_MOST_POINTS) view->header_size = place;
}

int sweep_log_map(sweep_log_view *out, const char *path, bike_file_error *error) {
  *out = (sweep_log_view){.path = path, .data = ""};
  const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return bike_message_system(error, path, errno);
  const int code = map(out, descriptor, error);
  close(descriptor);
  if (!code) read_header(out);
  return code;
}

void sweep_log_unmap(sweep_log_view *view) {
  if (view->size > 0) munmap((void *)(uintptr_t)view->data, view->size);
  *view = (sweep_log_view){0};
}

bool sweep_log_is(const sweep_log_view *view, const char *path) {
  struct stat status;
  return stat(path, &status) == 0 && status.st_dev == view->device && status.st_ino == view->file;
}

const char *sweep_log_objection(char out[BIKE_MESSAGE_SIZE], const sweep_log_view *view) {
  if (view->format && view->format != SWEEP_LOG_FORMAT)
    snprintf(out, BIKE_MESSAGE_SIZE,
             "is a log of format %ld, of another version of the program; this one has format %d",
             view->format, SWEEP_LOG_FORMAT);
  else
    snprintf(out, BIKE_MESSAGE_SIZE, "is not a log of bicycle sweep");
  return out;
}

bool sweep_log_next(sweep_log_view *view, size_t *place, sweep_record *out) {
  if (*place == 0) *place = view->header_size;
  for (;;) {
    const long length = line_length(view, *place);
    if (length < 0) {
      view->whole = *place;
      return false;
    }
    const char *line = view->data + *place;
    *place += (size_t)length + 1;
    if (sweep_parse_record(out, line, (size_t)length) && out->index >= 0 &&
        out->index < view->points)
      return true;
    view->damaged++;
  }
}
