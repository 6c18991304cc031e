// SPDX-License-Identifier: Apache-2.0
// Memory that runs out: the n-th allocation of a command fails, for many n. The command then ends
// with 3 and leaves nothing half written, or answers as if nothing had happened; it never answers
// something else, and never crashes by our own fault.
#include "fault_ledger.h"
#include "sandbox.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PATIENCE = 120, MOST_GROUPS = 256, LABEL = 600, LIBRARIES = 32 };

typedef enum outcome {
  REFUSED, // exit 3
  SAME,    // the undisturbed answer
  USAGE,   // exit 2: the message blames the input
  OTHER,   // another exit status
  SILENT,  // exit status as undisturbed, another answer
  HALF,    // an error, and something half written stays
  THEIRS,  // a crash within a library
  OURS,    // a crash of ours
  HANGS,
  OUTCOMES
} outcome;

static const char *const outcome_names[OUTCOMES] = {"exit 3", "same",   "exit 2", "other", "silent",
                                                    "half",   "theirs", "ours",   "hangs"};

typedef struct command {
  const char *line;
  // What an error may leave: rows that a restart goes on from, or a report of the error; NULL:
  // nothing.
  const char *leaves;
  const char *before; // shell, run in the empty folder before each run; NULL: nothing
  bool sampled;       // also in the sample that the suite runs
} command;

static const command commands[] = {
#include "memory_commands.h"
};

enum { COMMANDS = sizeof commands / sizeof *commands };

// Positions with one outcome and one cause.
typedef struct group {
  outcome outcome;
  char label[LABEL];
  long count, first;
} group;

static fault_ledger *ledger;
static int ledger_file;
static const char *preload = BICYCLE_FAULTS_LIBRARY;
static group groups[MOST_GROUPS];
static int group_count;

static void open_ledger(void) {
  ledger_file = memfd_create("ledger", 0);
  if (ledger_file < 0 || ftruncate(ledger_file, sizeof *ledger) != 0) exit(2);
  ledger = mmap(NULL, sizeof *ledger, PROT_READ | PROT_WRITE, MAP_SHARED, ledger_file, 0);
  if (ledger == MAP_FAILED) exit(2);
}

static int run_command(const command *c, long first, long last, int visits,
                       sandbox_content *content) {
  sandbox_clean();
  if (c->before) sandbox_shell(c->before);
  memset(ledger, 0, offsetof(fault_ledger, site));
  ledger->first = first;
  ledger->last = last;
  ledger->visits = visits;
  ledger->frozen_clock = 1;
  int status = sandbox_wait(sandbox_start(c->line, preload, ledger_file, PATIENCE));
  sandbox_look(content);
  return status;
}

//---------------------------------- whose crash ---------------------------------------------------

static bool is_of(const char *frame, const char *name) {
  const char *slash = strchr(frame, '('), *end = slash;
  while (slash && slash > frame && slash[-1] != '/') slash--;
  return slash && slash < end && strncmp(slash, name, strlen(name)) == 0;
}

// Frames that only pass a fault on: the C and C++ libraries, and ours that listens.
static bool is_messenger(const char *frame) {
  static const char *const names[] = {"libc.so", "libfault", "ld-linux", "libstdc++", "libgcc_s"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (is_of(frame, names[i])) return true;
  return !strchr(frame, '/');
}

static bool is_our_frame(const char *frame) {
  if (is_messenger(frame)) return false;
  if (strncmp(frame, BICYCLE_BINARY_DIR, strlen(BICYCLE_BINARY_DIR)) == 0) return true;
  return is_of(frame, "bicycle") || is_of(frame, "faults_library");
}

// The line of a frame.
static void copy_line(char *out, size_t size, const char *frame) {
  int length = (int)strcspn(frame, "\n");
  const char *base = frame;
  for (int i = 0; i < length && frame[i] != '('; i++)
    if (frame[i] == '/') base = frame + i + 1;
  snprintf(out, size, "%.*s", (int)(frame + length - base), base);
}

static const char *next_line(const char *text) {
  text = strchr(text, '\n');
  return text ? text + 1 : NULL;
}

// The first frame that may be to blame, NULL if there is none.
static const char *culprit(const char *text) {
  for (; text && *text; text = next_line(text))
    if (!is_messenger(text)) return text;
  return NULL;
}

static const char *first_of_ours(const char *text) {
  for (; text && *text; text = next_line(text))
    if (is_our_frame(text)) return text;
  return NULL;
}

//---------------------------------- what came of it -----------------------------------------------

// Whether each file is that of the undisturbed run, or was there before.
static bool is_whole(const command *c, const sandbox_content *now, const sandbox_content *whole) {
  for (int i = 0; i < now->count; i++) {
    const sandbox_file *file = &now->files[i], *other = sandbox_find(whole, file->path);
    if (strcmp(file->path, "stdout") == 0 ||
        (c->leaves && strncmp(file->path, c->leaves, strlen(c->leaves)) == 0))
      continue;
    if (!other || other->hash != file->hash) return false;
  }
  return true;
}

static outcome judge(const command *c, int status, int usual, const sandbox_content *now,
                     const sandbox_content *whole) {
  if (WIFSIGNALED(status)) {
    if (WTERMSIG(status) == SIGALRM) return HANGS;
    const char *frame = culprit(ledger->crash);
    return frame && !is_our_frame(frame) ? THEIRS : OURS;
  }
  int code = WEXITSTATUS(status);
  if (code == usual) return sandbox_same(now, whole) ? SAME : SILENT;
  if (code == 0) return SILENT;
  if (!is_whole(c, now, whole)) return HALF;
  return code == 3 ? REFUSED : code == 2 ? USAGE : OTHER;
}

static void describe(char out[LABEL], outcome what, int status) {
  char crash[120] = "", ours[120] = "", origin[120] = "", message[120] = "";
  const char *frame = culprit(ledger->crash);
  if (frame) copy_line(crash, sizeof crash, frame);
  frame = first_of_ours(ledger->crash[0] ? ledger->crash : ledger->failure);
  if (frame) copy_line(ours, sizeof ours, frame);
  frame = culprit(ledger->failure);
  if (frame) copy_line(origin, sizeof origin, frame);
  if (what == USAGE || what == OTHER || what == SILENT) sandbox_message(message, sizeof message);
  snprintf(out, LABEL, "status %x crash [%s] ours [%s] memory for [%s] %s", (unsigned)status, crash,
           ours, origin, message);
}

static void add_to_group(outcome what, int status, long position) {
  char label[LABEL];
  describe(label, what, status);
  for (int i = 0; i < group_count; i++)
    if (groups[i].outcome == what && strcmp(groups[i].label, label) == 0) {
      groups[i].count++;
      return;
    }
  if (group_count == MOST_GROUPS) return;
  group *g = &groups[group_count++];
  *g = (group){.outcome = what, .count = 1, .first = position};
  strcpy(g->label, label);
}

//---------------------------------- all positions of a command ------------------------------------

// Where a crash came from, counted over all commands.
static struct {
  char name[64];
  long count;
} libraries[LIBRARIES];

static void count_library(void) {
  const char *frame = culprit(ledger->crash);
  char name[64];
  copy_line(name, sizeof name, frame ? frame : "?");
  name[strcspn(name, "(")] = '\0';
  for (int i = 0; i < LIBRARIES; i++) {
    if (libraries[i].count && strcmp(libraries[i].name, name) != 0) continue;
    strcpy(libraries[i].name, name);
    libraries[i].count++;
    return;
  }
}

static int by_value(const void *a, const void *b) {
  long x = *(const long *)a, y = *(const long *)b;
  return (x > y) - (x < y);
}

// Positions to be tried: the first `visits` of each call stack.
static long *choose(const command *c, int visits, sandbox_content *content, long *count,
                    long *total) {
  run_command(c, 0, 0, visits, content);
  *total = atomic_load(&ledger->count);
  *count = atomic_load(&ledger->site_count);
  if (*count > LEDGER_SITES) *count = LEDGER_SITES;
  long *out = calloc((size_t)*count + 1, sizeof *out);
  if (!out) exit(2);
  memcpy(out, ledger->site, (size_t)*count * sizeof *out);
  qsort(out, (size_t)*count, sizeof *out, by_value);
  return out;
}

// Which positions of a command are tried.
typedef struct search {
  int visits;        // of a call stack
  long most, offset; // of a command
  bool onwards;      // all that come after fail too
} search;

// Whether two undisturbed runs leave the same; without that nothing can be told.
static bool run_twice(const command *c, int *usual, sandbox_content *whole) {
  static sandbox_content again;
  *usual = run_command(c, 0, 0, 0, whole);
  if (WIFEXITED(*usual) && run_command(c, 0, 0, 0, &again) == *usual && sandbox_same(whole, &again))
    return true;
  printf("%s: two undisturbed runs differ (status %x)\n", c->line, (unsigned)*usual);
  for (int i = 0; i < whole->count && i < again.count; i++)
    if (whole->files[i].hash != again.files[i].hash) printf("  %s\n", whole->files[i].path);
  return false;
}

static void print_row(const command *c, long total, const long counts[OUTCOMES]) {
  long tried = 0;
  for (int k = 0; k < OUTCOMES; k++) tried += counts[k];
  printf("%8ld %6ld", total, tried);
  for (int k = 0; k < OUTCOMES; k++) printf(" %6ld", counts[k]);
  printf("  %s\n", c->line);
}

// Adds what came to the totals. Whether something could be tried.
static bool try_command(const command *c, const search *s, long totals[OUTCOMES]) {
  static sandbox_content whole, now;
  long counts[OUTCOMES] = {0}, count, total;
  int usual;
  group_count = 0;
  if (!run_twice(c, &usual, &whole)) return false;
  long *positions = choose(c, s->visits, &now, &count, &total);
  long stride = (count + s->most - 1) / s->most;
  for (long i = stride ? s->offset % stride : 0; i < count; i += stride) {
    int status = run_command(c, positions[i], s->onwards ? LONG_MAX : positions[i], 0, &now);
    if (atomic_load(&ledger->failed) == 0) continue; // not reached this time
    outcome what = judge(c, status, WEXITSTATUS(usual), &now, &whole);
    counts[what]++;
    if (what == THEIRS) count_library();
    if (what != REFUSED && what != SAME) add_to_group(what, status, positions[i]);
  }
  free(positions);
  print_row(c, total, counts);
  for (int k = 0; k < OUTCOMES; k++) totals[k] += counts[k];
  return count > 0;
}

static void print_groups(bool all) {
  for (int i = 0; i < group_count; i++) {
    const group *g = &groups[i];
    if (!all && (g->outcome == THEIRS || g->outcome == USAGE || g->outcome == OTHER)) continue;
    printf("    %s: %ld times, first at %ld: %s\n", outcome_names[g->outcome], g->count, g->first,
           g->label);
  }
}

//---------------------------------- command line --------------------------------------------------

static const char help[] =
    "faults_memory [-v VISITS] [-m MOST] [-o OFFSET] [-c WORDS] [-q] [-n] [-x]\n"
    "Fails allocations of commands one at a time: the first VISITS (3) of every call stack, MOST "
    "of\n"
    "each command at equal distances from number OFFSET on; -q: of the sampled commands; -c: of\n"
    "those that hold WORDS; -n: all allocations from there on fail; -x: also explains what is no\n"
    "fault of ours.\n";

typedef struct arguments {
  search search;
  const char *only;
  bool quick, explain;
} arguments;

static arguments read_arguments(int argc, char **argv) {
  arguments args = {.search = {.visits = 3, .most = LEDGER_SITES}};
  for (int option; (option = getopt(argc, argv, "v:m:o:c:qnx")) != -1;) {
    switch (option) {
    case 'v':
      args.search.visits = atoi(optarg);
      break;
    case 'm':
      args.search.most = atol(optarg);
      break;
    case 'o':
      args.search.offset = atol(optarg);
      break;
    case 'c':
      args.only = optarg;
      break;
    case 'q':
      args.quick = true;
      break;
    case 'n':
      args.search.onwards = true;
      break;
    case 'x':
      args.explain = true;
      break;
    default:
      fputs(help, stderr);
      exit(2);
    }
  }
  return args;
}

static bool is_wanted(const command *c, const arguments *args) {
  return (!args->only || strstr(c->line, args->only)) && (!args->quick || c->sampled);
}

// The counts; whether there is any position, and no fault of ours.
static bool conclude(const long totals[OUTCOMES]) {
  long sum = 0;
  for (int i = 0; i < LIBRARIES && libraries[i].count; i++)
    printf("crashes in %s: %ld\n", libraries[i].name, libraries[i].count);
  for (int k = 0; k < OUTCOMES; k++) sum += totals[k];
  printf("%ld positions: %ld exit 3, %ld same, %ld exit 2, %ld other, %ld silent, %ld half "
         "written, %ld crashes of libraries, %ld crashes of ours, %ld hang\n",
         sum, totals[REFUSED], totals[SAME], totals[USAGE], totals[OTHER], totals[SILENT],
         totals[HALF], totals[THEIRS], totals[OURS], totals[HANGS]);
  return sum > 0 && totals[SILENT] + totals[HALF] + totals[OURS] + totals[HANGS] == 0;
}

int main(int argc, char **argv) {
  const arguments args = read_arguments(argc, argv);
  bool good = true;
  long totals[OUTCOMES] = {0};
  personality(ADDR_NO_RANDOMIZE); // of what is started: the same call stacks in every run
  setenv("OMP_NUM_THREADS", "1", 1);
  setvbuf(stdout, NULL, _IOLBF, 0);
  sandbox_enter();
  open_ledger();
  sandbox_shell("sh " BICYCLE_SOURCE_DIR "/tests/faults/inputs.sh");
  printf("   calls  tried");
  for (int k = 0; k < OUTCOMES; k++) printf(" %6s", outcome_names[k]);
  printf("  command\n");
  for (int i = 0; i < COMMANDS; i++) {
    if (!is_wanted(&commands[i], &args)) continue;
    good &= try_command(&commands[i], &args.search, totals);
    print_groups(args.explain);
  }
  return conclude(totals) && good ? 0 : 1;
}
