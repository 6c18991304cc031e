// SPDX-License-Identifier: Apache-2.0
#include <bicycle/error.h>
#include <bicycle/output.h>

#include "message.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
  // Other processes and threads differ by process number and counter, so a name can only be taken
  // by the leftover of a killed process; a few more names are then tried.
  NAME_ATTEMPTS = 64,
  DESCRIPTOR_PATH_SIZE = 64 // "/proc/self/fd/" and an int
};

static const char *shown(const bike_output *out) {
  return out->target ? out->target : "standard output";
}

static void release(bike_output *out) {
  free(out->target);
  free(out->temporary);
  *out = (bike_output){0};
}

// The next name beside the target, to be freed; NULL when out of memory.
static char *next_name(const bike_output *out) {
  static atomic_uint counter;
  const char *slash = strrchr(out->target, '/');
  const char *base = slash ? slash + 1 : out->target;
  const int folder = (int)(base - out->target);
  char *name = NULL;
  if (asprintf(&name, "%.*s.%s.%ld-%u.tmp", folder, out->target, base, (long)getpid(),
               atomic_fetch_add(&counter, 1U)) < 0)
    return NULL;
  return name;
}

// A file without a name in the target's folder, or -1 where that does not exist.
static int open_nameless(const bike_output *out) {
  if (access("/proc/self/fd", X_OK) != 0) return -1; // linkat needs it to name the file
  const char *slash = strrchr(out->target, '/');
  char *folder = slash ? strndup(out->target, (size_t)(slash - out->target) + 1) : strdup(".");
  const int descriptor = folder ? open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666) : -1;
  free(folder);
  return descriptor;
}

static int open_named(bike_output *out) {
  for (int i = 0; i < NAME_ATTEMPTS; ++i) {
    char *name = next_name(out);
    errno = ENOMEM;
    const int descriptor = name ? open(name, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666) : -1;
    if (descriptor >= 0) {
      out->temporary = name;
      return descriptor;
    }
    const int number = errno;
    free(name);
    errno = number;
    if (number != EEXIST) return -1;
  }
  return -1;
}

// Opens the stream on which a regular file is written aside. `old` is the file to be replaced, or
// NULL. Returns 0 or errno.
static int open_aside(bike_output *out, const struct stat *old) {
  int descriptor = open_nameless(out);
  if (descriptor < 0) descriptor = open_named(out);
  if (descriptor < 0) return errno;
  if (old && fchmod(descriptor, old->st_mode & 07777) != 0) {
    const int number = errno;
    close(descriptor);
    return number;
  }
  out->stream = fdopen(descriptor, "w");
  if (out->stream) return 0;
  const int number = errno;
  close(descriptor);
  return number;
}

// Opens a device or a pipe. Returns 0 or errno.
static int open_direct(bike_output *out, const char *path) {
  out->direct = true;
  out->target = strdup(path);
  if (!out->target) return ENOMEM;
  out->stream = fopen(path, "we");
  return out->stream ? 0 : errno;
}

// Opens what `path` names. Returns 0 or errno.
static int open_target(bike_output *out, const char *path) {
  struct stat status;
  if (stat(path, &status) != 0) {
    if (errno != ENOENT) return errno;
    if (*path == '\0') return ENOENT;
    if (path[strlen(path) - 1] == '/') return EISDIR;
    out->target = strdup(path);
    return out->target ? open_aside(out, NULL) : ENOMEM;
  }
  if (S_ISDIR(status.st_mode)) return EISDIR;
  if (!S_ISREG(status.st_mode)) return open_direct(out, path);
  // rename alone would replace a read-only file
  if (faccessat(AT_FDCWD, path, W_OK, AT_EACCESS) != 0) return errno;
  out->target = realpath(path, NULL);
  return out->target ? open_aside(out, &status) : errno;
}

int bike_output_begin(bike_output *out, const char *path, bike_file_error *error) {
  *out = (bike_output){0};
  if (!path || strcmp(path, "-") == 0) {
    out->stream = stdout;
    out->direct = true;
    return BIKE_OK;
  }
  const int number = open_target(out, path);
  if (!number) return BIKE_OK;
  bike_output_abort(out);
  return bike_message_system(error, path, number);
}

// Names the finished nameless file; a leftover of the same name is stepped over.
static int link_temporary(bike_output *out) {
  char descriptor[DESCRIPTOR_PATH_SIZE];
  snprintf(descriptor, sizeof descriptor, "/proc/self/fd/%d", fileno(out->stream));
  for (int i = 0; i < NAME_ATTEMPTS; ++i) {
    char *name = next_name(out);
    if (!name) return ENOMEM;
    if (linkat(AT_FDCWD, descriptor, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0) {
      out->temporary = name;
      return 0;
    }
    const int number = errno;
    free(name);
    if (number != EEXIST) return number;
  }
  return EEXIST;
}

// Everything to the file system. A failed write that came earlier has lost its errno: what lasts,
// as a full disk does, stops one more byte too and is named; the rest is EIO.
static int flush(FILE *stream) {
  const bool failed = ferror(stream) != 0;
  if (fflush(stream) != 0) return errno;
  if (!failed) return 0;
  return fputc('\n', stream) == EOF || fflush(stream) != 0 ? errno : EIO;
}

// Flushes, names and closes the stream. Returns 0 or errno.
static int finish(bike_output *out) {
  int number = flush(out->stream);
  if (!number && !out->direct && !out->temporary) number = link_temporary(out);
  if (out->stream != stdout) {
    if (fclose(out->stream) != 0 && !number) number = errno;
    out->stream = NULL;
  }
  if (!number && !out->direct && rename(out->temporary, out->target) != 0) number = errno;
  return number;
}

int bike_output_commit(bike_output *out, bike_file_error *error) {
  if (!out->stream) return bike_message(error, BIKE_ERROR_ARGUMENT, "no output was begun");
  const int number = finish(out);
  if (!number) {
    release(out);
    return BIKE_OK;
  }
  const int code = bike_message_system(error, shown(out), number);
  bike_output_abort(out);
  return code;
}

void bike_output_abort(bike_output *out) {
  if (out->stream && out->stream != stdout) fclose(out->stream);
  if (out->temporary) unlink(out->temporary);
  release(out);
}
