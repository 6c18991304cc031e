// SPDX-License-Identifier: Apache-2.0
// Commands that are killed at a random moment: what they were to replace is then as it was or as it
// should become, whole; a sweep goes on where it was, with nothing lost and nothing done twice.
#include "sandbox.h"

#include "support/random.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>

enum { PATIENCE = 120 };

typedef struct victim {
  const char *name;
  const char *before; // shell: an older output of the same name; NULL: none
  const char *line;
} victim;

static const victim victims[] = {
    {"ride", "bicycle ride roadster --speed 5 --time 1 --sample 0.1 -o out.csv 2>said",
     "bicycle ride roadster --speed 6 --lean-rate 0.2 --time 20 --sample 0.001 -o out.csv"},
    {"figures", NULL,
     "bicycle figures roadster -o figures --speeds 4:7:9 --leans 0:0.5:9 --inertia 0:0.2:9 "
     "--trail 0:0.1:9 --threads 1"},
    {"mjcf", "bicycle mujoco mjcf benchmark --speed 5 -o model/ --no-picture 2>said",
     "bicycle-mujoco mjcf benchmark --speed 6 -o model/ --no-picture"},
    {"validate", "cp -r ../in/report .", "bicycle-validate ../in/other.yml -o report -j 1"},
};

enum { VICTIMS = sizeof victims / sizeof *victims };

typedef struct tally {
  long kills, ended, old, new, between, lost;
} tally;

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void sleep_for(double time) {
  const time_t whole = (time_t)time;
  nanosleep(&(struct timespec){whole, (long)(1e9 * (time - (double)whole))}, NULL);
}

// Whether it was killed; else it had ended.
static bool kill_at(const char *line, double time) {
  pid_t child = sandbox_start(line, NULL, -1, PATIENCE);
  sleep_for(time);
  kill(child, SIGKILL);
  return WIFSIGNALED(sandbox_wait(child));
}

// What a killed process leaves beside its output bears its number in a hidden name.
static bool counts(const char *path) {
  return path[0] != '.' && strcmp(path, "stdout") != 0 && strcmp(path, "said") != 0;
}

static int count_files(const sandbox_content *content) {
  int count = 0;
  for (int i = 0; i < content->count; i++) count += counts(content->files[i].path);
  return count;
}

// Whether every file is there with the same bytes, or the same name where reports tell the time.
static int count_alike(const sandbox_content *now, const sandbox_content *other, bool bytes) {
  int alike = 0;
  for (int i = 0; i < now->count; i++) {
    const sandbox_file *file = &now->files[i], *same = sandbox_find(other, file->path);
    alike += counts(file->path) && same && (!bytes || same->hash == file->hash);
  }
  return alike;
}

static bool is_like(const sandbox_content *now, const sandbox_content *other, bool bytes) {
  int files = count_files(now);
  return files == count_files(other) && count_alike(now, other, bytes) == files;
}

// A report must say itself that it is whole: its last view names the run, its page ends.
static bool report_is_whole(void) {
  char command[256];
  snprintf(command, sizeof command,
           "cd %s/run && tail -n 1 report/report.html | grep -q '</html>' && "
           "tail -n 1 report/summary.md | grep -q 'bicycle validate' && "
           "tail -n 1 report/junit.xml | grep -q '</testsuites>' && "
           "tail -n 1 report/report.json | grep -q '^}$'",
           sandbox_home());
  return system(command) == 0;
}

// Figures are files of their own, each of which is whole; the others appear at once.
static void judge(tally *t, const victim *v, const sandbox_content *now, const sandbox_content *old,
                  const sandbox_content *new) {
  const bool report = strcmp(v->name, "validate") == 0, apart = strcmp(v->name, "figures") == 0;
  if (is_like(now, old, true))
    t->old++;
  else if (is_like(now, new, !report) && (!report || report_is_whole()))
    t->new ++;
  else if (apart && count_alike(now, new, true) == count_files(now))
    t->between++;
  else
    t->lost++;
}

static void prepare(const victim *v) {
  sandbox_clean();
  if (v->before) sandbox_shell(v->before);
}

static bool try_victim(const victim *v, long kills, random_source *random) {
  static sandbox_content old, new, now;
  tally t = {0};
  prepare(v);
  sandbox_look(&old);
  double begun = seconds();
  if (sandbox_wait(sandbox_start(v->line, NULL, -1, PATIENCE)) != 0) return false;
  double length = seconds() - begun;
  sandbox_look(&new);
  while (t.kills < kills && t.ended < 20 * kills + 20) {
    prepare(v);
    bool killed = kill_at(v->line, random_between(random, 0, 1.05) * length);
    sandbox_look(&now);
    t.kills += killed;
    t.ended += !killed;
    judge(&t, v, &now, &old, &new);
  }
  printf("%-9s %4ld killed, %ld ended before: %ld outputs old or absent, %ld new, %ld with part of "
         "the files, %ld lost\n",
         v->name, t.kills, t.ended, t.old, t.new, t.between, t.lost);
  return t.lost == 0 && t.kills == kills;
}

//---------------------------------- sweeps --------------------------------------------------------

// Kills and restarts a sweep until it ends by itself; its table is then that of a sweep
// undisturbed.
static bool sweep_to_the_end(long *kills, double length, random_source *random) {
  char check[512];
  sandbox_clean();
  for (int i = 0; i < 1000; i++) {
    double time = random_between(random, 0.05, 0.5) * length * (1 + 0.02 * i); // so that it ends
    if (!kill_at("bicycle-sweep ../in/many.yml -o out --threads 2", time)) break;
    ++*kills;
  }
  snprintf(
      check, sizeof check,
      "cd %s/run && cmp out.csv ../in/whole.csv && bicycle sweep merge out.log --json >said && "
      "grep -q '\"missing\": 0' said && grep -q '\"repeated\": 0' said && "
      "grep -q '\"contradictory\": 0' said",
      sandbox_home());
  return system(check) == 0;
}

static bool try_sweep(long kills, random_source *random) {
  long done = 0, sweeps = 0, lost = 0;
  double begun = seconds();
  sandbox_clean();
  sandbox_shell("bicycle sweep ../in/many.yml -o ../in/whole --threads 2 >said");
  double length = seconds() - begun;
  for (; done < kills && sweeps < kills + 100; sweeps++)
    lost += !sweep_to_the_end(&done, length, random);
  printf("sweep     %4ld killed on the way of %ld sweeps to their end: %ld lost\n", done, sweeps,
         lost);
  return lost == 0 && done >= kills;
}

int main(int argc, char **argv) {
  long kills = argc > 1 ? atol(argv[1]) : 1000, part = (kills + VICTIMS) / (VICTIMS + 1);
  bool good = true;
  if (kills < 1) return 2;
  setvbuf(stdout, NULL, _IOLBF, 0);
  random_source random = random_begin("faults_kills", 1);
  sandbox_enter();
  sandbox_shell("sh " BICYCLE_SOURCE_DIR "/tests/faults/inputs.sh");
  for (int i = 0; i < VICTIMS; i++) good &= try_victim(&victims[i], part, &random);
  good &= try_sweep(part, &random);
  printf("Kills: %ld, %s\n", part * (VICTIMS + 1), good ? "lost 0" : "NOT ALL WELL");
  return good ? 0 : 1;
}
