// SPDX-License-Identifier: Apache-2.0
// The log of a sweep: a header, then one record a point in the order in which they were done. Only
// whole lines count, so that it is valid at any moment; a torn end is cut off when it is resumed.
#ifndef SWEEP_LOG_H
#define SWEEP_LOG_H

#include "record.h"

#include <bicycle/file.h>
#include <sys/types.h>

// What a record means. 1, before the first release: a point had all its outputs or none.
#define SWEEP_LOG_FORMAT 2

// What the header says: five lines, "# bicycle-sweep log 2", the program's version, the hash of the
// spec, the number of points, the columns. Logs with the same header are parts of the same sweep.
char *sweep_log_header(const sweep_spec *spec); // free it; NULL when out of memory

// A log in memory.
typedef struct sweep_log_view {
  const char *path;    // the caller's
  dev_t device;        // with `file`: which file it is, whatever its names
  ino_t file;          //
  const char *data;    // mapped
  size_t size;         //
  long format;         // that the first line tells; 0: none
  size_t header_size;  // 0: no whole header of this format
  long points;         // of the header
  const char *columns; // of the header, up to the line feed
  long damaged;        // whole lines that are no records; counted while reading
  size_t whole;        // bytes up to the end of the last whole line; known when all is read
} sweep_log_view;

// Maps a log for reading. BIKE_ERROR_FILE or BIKE_ERROR_SYNTAX (it is something else, and not an
// unfinished header either) with one line in `error`.
int sweep_log_map(sweep_log_view *out, const char *path, bike_file_error *error);
void sweep_log_unmap(sweep_log_view *view);

// Whether `path` leads to the very file of the log.
bool sweep_log_is(const sweep_log_view *view, const char *path);

// What is wrong with a log without a whole header: "is not a log of bicycle sweep", or another
// format; `out` holds it.
const char *sweep_log_objection(char out[BIKE_MESSAGE_SIZE], const sweep_log_view *view);

// The next record; `place` starts at 0.
bool sweep_log_next(sweep_log_view *view, size_t *place, sweep_record *out);

// A log being written, locked against other processes.
typedef struct sweep_log {
  const char *path; // the caller's
  int descriptor;   // -1: closed
} sweep_log;

// Called for each record that is already there.
typedef void sweep_record_visitor(const sweep_record *record, void *user);

// Opens a log to append to, begins it where there is none (or `fresh` asks to start over), and
// shows what it holds. BIKE_ERROR_FILE, BIKE_ERROR_SYNTAX for the log of something else,
// BIKE_ERROR_MEMORY. `damaged` counts lines that are passed over.
int sweep_log_open(sweep_log *out, const char *path, const sweep_spec *spec, bool fresh,
                   sweep_record_visitor *visit, void *user, long *damaged, bike_file_error *error);

// Appends whole records. False with errno set where that is not possible.
bool sweep_log_append(const sweep_log *log, const char *text, size_t size);

void sweep_log_close(sweep_log *log);

#endif
