// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program: counts its allocations, fails some of them as a fault_ledger says, and
// tells where a crash comes from.
#include "fault_ledger.h"

#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <malloc.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <time.h>

// glibc's own, to which every allocation goes that does not fail.
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);

enum { DEPTH = 48, STACKS = 1 << 18 };

static fault_ledger *ledger;
static __thread bool inside __attribute__((tls_model("initial-exec"))); // this library's own calls
static struct {
  uint64_t hash;
  int visits;
} stacks[STACKS];
static atomic_flag busy = ATOMIC_FLAG_INIT;

//---------------------------------- backtraces ----------------------------------------------------

static size_t put(char out[LEDGER_TEXT], size_t used, const char *text) {
  size_t length = strlen(text);
  if (used + length >= LEDGER_TEXT) return used;
  memcpy(out + used, text, length + 1);
  return used + length;
}

static void write_frames(char out[LEDGER_TEXT], void *const *frames, int count) {
  size_t used = 0;
  for (int i = 0; i < count; i++) {
    Dl_info info = {0};
    char offset[40];
    if (!dladdr(frames[i], &info)) continue;
    const char *base = info.dli_sname ? info.dli_saddr : info.dli_fbase;
    used = put(out, used, info.dli_fname ? info.dli_fname : "?");
    used = put(out, used, "(");
    used = put(out, used, info.dli_sname ? info.dli_sname : "");
    snprintf(offset, sizeof offset, "+0x%zx)\n", (size_t)((char *)frames[i] - base));
    used = put(out, used, offset);
  }
}

static void on_crash(int number) {
  void *frames[DEPTH];
  inside = true;
  if (ledger) {
    ledger->signal = number;
    write_frames(ledger->crash, frames, backtrace(frames, DEPTH));
  }
  signal(number, SIG_DFL);
  raise(number);
}

static void catch_crashes(void) {
  static char room[1 << 17];
  const stack_t stack = {.ss_sp = room, .ss_size = sizeof room};
  struct sigaction action = {.sa_handler = on_crash, .sa_flags = SA_ONSTACK | SA_NODEFER};
  const int numbers[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
  sigaltstack(&stack, NULL);
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    sigaction(numbers[i], &action, NULL);
}

__attribute__((constructor)) static void begin(void) {
  void *frames[2];
  inside = true;
  backtrace(frames, 2); // loads what it needs
  void *map = mmap(NULL, sizeof *ledger, PROT_READ | PROT_WRITE, MAP_SHARED, LEDGER_DESCRIPTOR, 0);
  if (map != MAP_FAILED) ledger = map;
  catch_crashes();
  inside = false;
}

//---------------------------------- which allocations fail ----------------------------------------

// Lists an allocation unless its call stack has been listed often enough.
static void note_site(long number) {
  void *frames[DEPTH];
  uint64_t hash = 14695981039346656037U;
  int count = backtrace(frames, DEPTH);
  for (int i = 2; i < count; i++) hash = (hash ^ (uintptr_t)frames[i]) * 1099511628211U;
  while (atomic_flag_test_and_set(&busy)) {
  }
  size_t at = hash % STACKS;
  while (stacks[at].visits && stacks[at].hash != hash) at = (at + 1) % STACKS;
  stacks[at].hash = hash;
  if (stacks[at].visits++ < ledger->visits) {
    long index = atomic_fetch_add(&ledger->site_count, 1);
    if (index < LEDGER_SITES) ledger->site[index] = number;
  }
  atomic_flag_clear(&busy);
}

static bool fails(void) {
  if (!ledger || inside) return false;
  long number = atomic_fetch_add(&ledger->count, 1) + 1;
  bool chosen = number >= ledger->first && number <= ledger->last;
  inside = true;
  if (ledger->visits) note_site(number);
  if (chosen && atomic_fetch_add(&ledger->failed, 1) == 0) {
    void *frames[DEPTH];
    write_frames(ledger->failure, frames, backtrace(frames, DEPTH));
  }
  inside = false;
  if (chosen) errno = ENOMEM;
  return chosen;
}

void *malloc(size_t size) {
  return fails() ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
  return fails() ? NULL : __libc_calloc(count, size);
}

void *realloc(void *old, size_t size) {
  return fails() ? NULL : __libc_realloc(old, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
  return fails() ? NULL : __libc_memalign(alignment, size);
}

void *memalign(size_t alignment, size_t size) {
  return fails() ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **out, size_t alignment, size_t size) {
  if (fails()) return ENOMEM;
  *out = __libc_memalign(alignment, size);
  return *out ? 0 : ENOMEM;
}

//---------------------------------- clocks --------------------------------------------------------

int clock_gettime(clockid_t clock, struct timespec *out) {
  static int (*real)(clockid_t, struct timespec *);
  if (ledger && ledger->frozen_clock) {
    *out = (struct timespec){.tv_sec = 1700000000};
    return 0;
  }
  inside = true;
  if (!real) *(void **)&real = dlsym(RTLD_NEXT, "clock_gettime");
  inside = false;
  return real(clock, out);
}

time_t time(time_t *out) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (out) *out = now.tv_sec;
  return now.tv_sec;
}

int gettimeofday(struct timeval *restrict out, void *restrict zone) {
  struct timespec now;
  (void)zone;
  clock_gettime(CLOCK_REALTIME, &now);
  *out = (struct timeval){now.tv_sec, now.tv_nsec / 1000};
  return 0;
}
