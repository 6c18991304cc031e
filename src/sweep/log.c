// SPDX-License-Identifier: Apache-2.0
// Writing the log: opening, locking, resuming, appending.
#include "log.h"

#include "files/memory_stream.h"
#include "files/message.h"
#include "terminal/command.h"

#include <bicycle/error.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

char *sweep_log_header(const sweep_spec *spec) {
  char *text = NULL;
  size_t size;
  FILE *stream = bike_memory_stream(&text, &size);
  if (!stream) return NULL;
  fprintf(stream, "# bicycle-sweep log %d\n# version %s\n# spec %s\n# points %ld\n# columns ",
          SWEEP_LOG_FORMAT, term_version(), spec->hash, spec->points);
  sweep_print_columns(stream, spec);
  fputc('\n', stream);
  if (fclose(stream) == 0) return text;
  free(text);
  return NULL;
}

// A lock that ends with the process. File systems without locks are trusted.
static int lock(const sweep_log *log, bike_file_error *error) {
  if (flock(log->descriptor, LOCK_EX | LOCK_NB) == 0 || errno == ENOLCK || errno == EOPNOTSUPP)
    return BIKE_OK;
  if (errno == EWOULDBLOCK)
    return bike_message(error, BIKE_ERROR_FILE, "%s: another process is writing it", log->path);
  return bike_message_system(error, log->path, errno);
}

bool sweep_log_append(const sweep_log *log, const char *text, size_t size) {
  while (size > 0) {
    const ssize_t written = write(log->descriptor, text, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text += written;
    size -= (size_t)written;
  }
  return true;
}

static int begin(const sweep_log *log, const char *header, bike_file_error *error) {
  if (ftruncate(log->descriptor, 0) == 0 && sweep_log_append(log, header, strlen(header)))
    return BIKE_OK;
  return bike_message_system(error, log->path, errno);
}

// Whether the log is this sweep's: which line differs tells what is wrong.
static int compare_headers(const sweep_log_view *view, const char *header, bike_file_error *error) {
  const char *theirs = view->data, *ours = header;
  static const char *const what[] = {
      "is not a log of bicycle sweep", "was written by another version of the program",
      "belongs to another spec, or the spec or its bicycle was edited since"};
  if (view->header_size == strlen(header) && memcmp(theirs, ours, view->header_size) == 0)
    return BIKE_OK;
  int line = 0;
  for (; line < 2; line++) {
    const size_t length = strcspn(ours, "\n") + 1;
    if (strncmp(theirs, ours, length) != 0) break;
    theirs += length;
    ours += length;
  }
  return bike_message(error, BIKE_ERROR_SYNTAX,
                      "%s: %s: choose another -o, or start over with --fresh", view->path,
                      what[line]);
}

static int resume(const sweep_log *log, const char *header, sweep_record_visitor *visit, void *user,
                  long *damaged, bike_file_error *error) {
  sweep_log_view view;
  sweep_record record;
  size_t place = 0;
  char what[BIKE_MESSAGE_SIZE];
  int code = sweep_log_map(&view, log->path, error);
  if (code) return code;
  // Killed before its header was whole: nothing is lost.
  const bool begun = view.header_size > 0;
  if (!begun && strncmp(view.data, header, view.size) != 0)
    code = bike_message(error, BIKE_ERROR_SYNTAX, "%s: %s: choose another -o%s", log->path,
                        sweep_log_objection(what, &view),
                        view.format ? ", or start over with --fresh" : "");
  if (!code && begun) code = compare_headers(&view, header, error);
  while (!code && begun && sweep_log_next(&view, &place, &record)) visit(&record, user);
  *damaged = view.damaged;
  const off_t whole = (off_t)view.whole;
  sweep_log_unmap(&view);
  if (code) return code;
  if (!begun) return begin(log, header, error);
  return ftruncate(log->descriptor, whole) == 0 ? BIKE_OK
                                                : bike_message_system(error, log->path, errno);
}

static int open_file(sweep_log *out, const char *path, bike_file_error *error) {
  struct stat status;
  *out = (sweep_log){path, open(path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)};
  if (out->descriptor < 0) return bike_message_system(error, path, errno);
  if (fstat(out->descriptor, &status) != 0) return bike_message_system(error, path, errno);
  if (!S_ISREG(status.st_mode))
    return bike_message(error, BIKE_ERROR_FILE, "%s: is not a regular file", path);
  return lock(out, error);
}

int sweep_log_open(sweep_log *out, const char *path, const sweep_spec *spec, bool fresh,
                   sweep_record_visitor *visit, void *user, long *damaged, bike_file_error *error) {
  *damaged = 0;
  int code = open_file(out, path, error);
  char *header = code ? NULL : sweep_log_header(spec);
  if (!code && !header) code = bike_message(error, BIKE_ERROR_MEMORY, "out of memory");
  if (!code && header) {
    code = fresh ? begin(out, header, error) : resume(out, header, visit, user, damaged, error);
  }
  free(header);
  if (code) sweep_log_close(out);
  return code;
}

void sweep_log_close(sweep_log *log) {
  if (log->descriptor >= 0) close(log->descriptor);
  log->descriptor = -1;
}
