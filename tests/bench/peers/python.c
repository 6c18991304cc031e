// SPDX-License-Identifier: Apache-2.0
#include "python.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// The Python for which Debian's scipy is built, unless the user knows of a better one. A python3
// that comes first on PATH often has no scipy.
static const char PYTHON[] = "/usr/bin/python3";

// An answer takes a second at most, the first one with scipy's import some more.
enum { PATIENCE_MS = 60000 };

struct python_peer {
  pid_t child; // 0: not started, or given up
  bool tried;
  FILE *requests;
  int answers; // kept open without a stream, for poll
  char *line;
  size_t used, size;
};

python_peer *python_open(void) {
  python_peer *p = calloc(1, sizeof *p);
  if (p) p->answers = -1;
  return p;
}

// Also after a child that does not answer: it is ours and holds nothing worth keeping.
static void give_up(python_peer *p) {
  if (p->requests) fclose(p->requests);
  if (p->answers >= 0) close(p->answers);
  if (p->child > 0) {
    kill(p->child, SIGKILL);
    while (waitpid(p->child, NULL, 0) < 0 && errno == EINTR) continue;
  }
  p->requests = NULL;
  p->answers = -1;
  p->child = 0;
}

void python_close(python_peer *p) {
  if (!p) return;
  give_up(p);
  free(p->line);
  free(p);
}

// One thread, as everything else here; -I: nothing of the user's own among the modules.
static int spawn(pid_t *child, int in, int out) {
  const char *other = getenv("BICYCLE_BENCH_PYTHON");
  char *program = (char *)(other && *other ? other : PYTHON);
  char *arguments[] = {program, "-I", BENCH_PEERS_DIR "/scipy_peer.py", NULL};
  char *environment[] = {"OPENBLAS_NUM_THREADS=1", "OMP_NUM_THREADS=1", "PATH=/usr/bin:/bin", NULL};
  posix_spawn_file_actions_t actions;
  if (posix_spawn_file_actions_init(&actions)) return ENOMEM;
  int failed = posix_spawn_file_actions_adddup2(&actions, in, 0);
  if (!failed) failed = posix_spawn_file_actions_adddup2(&actions, out, 1);
  // why an import fails comes back as the reason, not as a traceback
  if (!failed) failed = posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  if (!failed) failed = posix_spawnp(child, program, &actions, NULL, arguments, environment);
  posix_spawn_file_actions_destroy(&actions);
  return failed;
}

static bool start(python_peer *p, bench_notes *notes) {
  int in[2] = {-1, -1}, out[2] = {-1, -1};
  p->tried = true;
  signal(SIGPIPE, SIG_IGN); // a child that is gone shows as an error of the write
  if (pipe2(in, O_CLOEXEC) || pipe2(out, O_CLOEXEC)) return bench_note_reason(notes, "no pipe");
  int failed = spawn(&p->child, in[0], out[1]);
  close(in[0]);
  close(out[1]);
  p->answers = out[0];
  p->requests = fdopen(in[1], "w");
  if (failed) p->child = 0;
  if (!failed && p->requests) return true;
  give_up(p);
  return bench_note_reason(notes, "Python cannot be started: %s", strerror(failed));
}

// Waits for a whole line; the text without its end, NULL at the end of the stream or of patience.
static const char *next_line(python_peer *p) {
  p->used = 0;
  for (;;) {
    if (p->used + 1 >= p->size) {
      size_t size = p->size ? 2 * p->size : 65536;
      char *line = realloc(p->line, size);
      if (!line) return NULL;
      p->line = line;
      p->size = size;
    }
    struct pollfd ready = {.fd = p->answers, .events = POLLIN};
    if (poll(&ready, 1, PATIENCE_MS) <= 0) return NULL;
    ssize_t got = read(p->answers, p->line + p->used, p->size - p->used - 1);
    if (got <= 0) return NULL;
    p->used += (size_t)got;
    if (p->line[p->used - 1] != '\n') continue;
    p->line[p->used - 1] = 0;
    return p->line;
  }
}

// What the child says, or why it says nothing.
static json_t *receive(python_peer *p, bench_notes *notes) {
  const char *line = next_line(p);
  json_t *answer = line ? json_loads(line, 0, NULL) : NULL;
  if (!answer) {
    bench_note_reason(notes, "Python with scipy and numpy does not answer: are python3-scipy and "
                             "python3-numpy installed?");
    give_up(p);
    return NULL;
  }
  const char *error = json_string_value(json_object_get(answer, "error"));
  if (!error) return answer;
  bench_note_reason(notes, "%s", error);
  json_decref(answer);
  return NULL;
}

json_t *python_ask(python_peer *p, json_t *request, bench_notes *notes) {
  bench_notes unheard = {0};
  if (!notes) notes = &unheard;
  if (!p->tried && !start(p, notes)) p->child = 0;
  if (!p->child || !request) {
    if (p->tried && !notes->reason[0]) bench_note_reason(notes, "Python does not answer");
    json_decref(request);
    return NULL;
  }
  // the child speaks when it is spoken to: a line each way
  bool sent = !json_dumpf(request, p->requests, JSON_COMPACT | JSON_REAL_PRECISION(17)) &&
              fputc('\n', p->requests) != EOF && !fflush(p->requests);
  (void)sent; // a write that fails ends in a read that does
  json_decref(request);
  return receive(p, notes);
}

double python_seconds(python_peer *p, json_t *request) {
  json_t *answer = python_ask(p, request, NULL);
  const json_t *seconds = json_object_get(answer, "seconds");
  double value = json_is_number(seconds) ? json_number_value(seconds) : NAN;
  json_decref(answer);
  return value;
}
