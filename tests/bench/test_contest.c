// SPDX-License-Identifier: Apache-2.0
// The judge: what is refused, what counts as measured, and which way a ratio goes.
#include "contest.h"
#include "support/near.h"
#include "tune.h"

#include <string.h>

// A side that claims to take a given time for each piece of work.
typedef struct clockwork {
  double seconds;
  long calls;
} clockwork;

static double claim(void *context, long repeats) {
  clockwork *c = context;
  c->calls++;
  return c->seconds * (double)repeats;
}

static bench_contest contest_of(clockwork *ours, clockwork *theirs, bench_sense sense) {
  return (bench_contest){.name = "test",
                         .question = "theirs / ours",
                         .ours = {"ours", .timed = claim, .context = ours},
                         .theirs = {"theirs", .timed = claim, .context = theirs},
                         .sense = sense,
                         .asked = 3};
}

static void ratio_goes_the_way_it_is_asked(void **state) {
  (void)state;
  clockwork ours = {2e-6, 0}, theirs = {8e-6, 0};
  const bench_effort effort = bench_quick_effort();
  bench_contest c = contest_of(&ours, &theirs, BENCH_AT_LEAST);
  bench_result r;
  bench_run(&r, &c, &effort);
  assert_int_equal(r.status, BENCH_MEASURED);
  assert_near(r.ratio, 4, 1e-12);
  assert_near(r.ours, 2e-6, 1e-18);
  assert_true(bench_met(&c, &r));
  c.asked = 5;
  assert_false(bench_met(&c, &r));
  c.asked = 0;
  assert_true(bench_met(&c, &r));
  c = contest_of(&ours, &theirs, BENCH_AT_MOST);
  bench_run(&r, &c, &effort);
  assert_near(r.ratio, 0.25, 1e-12);
  assert_true(bench_met(&c, &r));
  c.asked = 0.2;
  assert_false(bench_met(&c, &r));
  assert_false(bench_noisy(&r));
}

static void units_divide_the_time(void **state) {
  (void)state;
  clockwork ours = {8e-6, 0}, theirs = {8e-6, 0};
  const bench_effort effort = bench_quick_effort();
  bench_contest c = contest_of(&ours, &theirs, BENCH_AT_LEAST);
  c.ours.units = 8;
  bench_result r;
  bench_run(&r, &c, &effort);
  assert_near(r.ours, 1e-6, 1e-18);
  assert_near(r.ratio, 8, 1e-12);
}

static void side_that_fails_is_not_measured(void **state) {
  (void)state;
  clockwork ours = {1e-6, 0}, theirs = {NAN, 0};
  const bench_effort effort = bench_quick_effort();
  bench_contest c = contest_of(&ours, &theirs, BENCH_AT_LEAST);
  bench_result r;
  bench_run(&r, &c, &effort);
  assert_int_equal(r.status, BENCH_NOT_MEASURED);
  assert_true(r.notes.reason[0] != 0);
  assert_true(isnan(r.ratio));
}

static bool absent(void *context, bench_notes *notes) {
  (void)context;
  return bench_note_reason(notes, "no %s here", "peer");
}

// The disagreement of the peer is the context.
static bool compared(void *context, bench_notes *notes) {
  bench_note_value(notes, "states", 1);
  bench_note_check(notes, "disagreement", *(double *)context, 1e-12);
  return true;
}

static void peer_that_disagrees_is_not_timed(void **state) {
  (void)state;
  static const struct {
    double disagreement;
    bench_status status;
  } cases[] = {{0, BENCH_MEASURED},
               {1e-12, BENCH_MEASURED},
               {1.1e-12, BENCH_REFUSED},
               {INFINITY, BENCH_REFUSED},
               {NAN, BENCH_REFUSED}};
  const bench_effort effort = bench_quick_effort();
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    clockwork ours = {1e-6, 0}, theirs = {1e-6, 0};
    double disagreement = cases[i].disagreement;
    bench_contest c = contest_of(&ours, &theirs, BENCH_AT_LEAST);
    c.prepare = compared;
    c.context = &disagreement;
    bench_result r;
    bench_run(&r, &c, &effort);
    assert_int_equal(r.status, cases[i].status);
    assert_int_equal(theirs.calls > 0, cases[i].status == BENCH_MEASURED);
    assert_int_equal(r.notes.reason[0] != 0, cases[i].status == BENCH_REFUSED);
  }
}

static void absent_peer_has_a_reason(void **state) {
  (void)state;
  clockwork ours = {1e-6, 0}, theirs = {1e-6, 0};
  const bench_effort effort = bench_quick_effort();
  bench_contest c = contest_of(&ours, &theirs, BENCH_AT_LEAST);
  c.prepare = absent;
  bench_result r;
  bench_run(&r, &c, &effort);
  assert_int_equal(r.status, BENCH_NOT_MEASURED);
  assert_string_equal(r.notes.reason, "no peer here");
  assert_int_equal(ours.calls + theirs.calls, 0);
}

static bool at_least(void *context, int k) {
  return k >= *(int *)context;
}

static void loosest_setting_is_found(void **state) {
  (void)state;
  for (int first = 3; first <= 20; first++)
    assert_int_equal(bench_loosest(at_least, &first, 3, 20), first);
  int never = 21, always = 0;
  assert_int_equal(bench_loosest(at_least, &never, 3, 20), -1);
  assert_int_equal(bench_loosest(at_least, &always, 3, 20), 3);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(ratio_goes_the_way_it_is_asked),
                                     cmocka_unit_test(units_divide_the_time),
                                     cmocka_unit_test(side_that_fails_is_not_measured),
                                     cmocka_unit_test(peer_that_disagrees_is_not_timed),
                                     cmocka_unit_test(absent_peer_has_a_reason),
                                     cmocka_unit_test(loosest_setting_is_found)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
