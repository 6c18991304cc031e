// SPDX-License-Identifier: Apache-2.0
// Output files that appear whole or not at all.
//
// A file is written without a name in the folder of its target (O_TMPFILE) and takes the target's
// name when it is complete, so that an abort, a signal or a crash before the commit leaves nothing
// behind and never damages an existing file. Where the file system has no nameless files, it is
// written beside the target as ".NAME.PID-COUNT.tmp"; only then can a killed program leave one.
#ifndef BICYCLE_OUTPUT_H
#define BICYCLE_OUTPUT_H

#include <bicycle/file.h>
#include <stdio.h>

// One output being written. Only `stream` is for the caller, who must not close it.
typedef struct bike_output {
  FILE *stream;    // write here, from begin to commit or abort; NULL otherwise
  char *target;    // the file that commit brings about, a device or pipe; NULL: standard output
  char *temporary; // the file beside the target, while there is one
  bool direct;     // written straight to the target: a device, a pipe, the standard output
} bike_output;

// Begins an output. `path` NULL or "-" is the standard output; a device or a pipe is written
// directly; a symbolic link is followed and stays. An existing file keeps its mode and, until the
// commit, its content. Errors: BIKE_ERROR_FILE (a folder, no permission, no such folder, ...) and
// BIKE_ERROR_MEMORY, with one line "path: what" in `error` (may be NULL); `out` is then safe to
// abort.
BIKE_API int bike_output_begin(bike_output *out, const char *path, bike_file_error *error);

// Ends an output: everything written stands under the target's name, or, on BIKE_ERROR_FILE
// (disk full, ...), nothing does. Also detects an earlier failed write.
BIKE_API int bike_output_commit(bike_output *out, bike_file_error *error);

// Ends an output without a trace; what went to the standard output, a device or a pipe stays there.
// Does nothing to an output that is zeroed or has ended.
BIKE_API void bike_output_abort(bike_output *out);

#endif
