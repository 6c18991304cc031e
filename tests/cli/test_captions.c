// SPDX-License-Identifier: Apache-2.0
// What pictures say beside their curves: which bicycle, which signs, what a key names, and that a
// contour which ends does so by nature.
#include "run.h"
#include "support/near.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SMALL " --inertia 0:0.4:11 --trail 0:0.16:11"

// The caption of a picture as one text, its markup left out; free it.
static char *caption_of(const char *name) {
  static const char begin[] = "<text class=\"caption\"";
  char *svg = run_read(name), *out = calloc(strlen(svg) + 1, 1), *end = out;
  for (const char *at = svg; (at = strstr(at, begin));) {
    const char *line_end = strstr(at, "</text>");
    bool in_tag = false;
    for (; at < line_end; at++) {
      if (*at == '<') in_tag = true;
      if (!in_tag) *end++ = *at;
      if (*at == '>') in_tag = false;
    }
    *end++ = ' ';
  }
  free(svg);
  return out;
}

static void expect_caption(const char *name, const char *words, bool is_there) {
  char *caption = caption_of(name);
  if ((strstr(caption, words) != NULL) != is_there) fail_msg("%s: %s", name, caption);
  free(caption);
}

static void captions_name_the_bicycle(void **state) {
  (void)state;
  run_well("bicycle figures roadster -o named --speeds 2:10:21 --leans 0:30deg:11" SMALL);
  expect_caption("named/fig2a.svg", "Figure 2(a), roadster. Steering angle", true);
  expect_caption("named/fig2d.svg", "Figure 2(d), roadster. Time", true);
  expect_caption("named/fig3.svg", "Figure 3, roadster. Self-stability", true);
  expect_caption("named/fig4.svg", "Figure 4, roadster. Self-stability", true);
}

// The page and the one picture whose sign depends on it.
static void the_sense_of_the_steer_is_told(void **state) {
  (void)state;
  static const struct {
    const char *convention, *side, *page;
  } cases[] = {{"iso", "steer to the left.", "steer to the left (ISO 8855)"},
               {"sae", "steer to the right.", "steer to the right (as in the literature)"}};
  for (int i = 0; i < 2; i++) {
    char command[200];
    snprintf(
        command, sizeof command,
        "bicycle figures roadster -o signs --speeds 5:6:3 --leans 0:3deg:3 --convention %s" SMALL,
        cases[i].convention);
    run_well(command);
    expect_caption("signs/fig2a.svg", cases[i].side, true);
    expect_caption("signs/fig2b.svg", "steer to the", false);
    char *page = run_read("signs/index.html");
    assert_non_null(strstr(page, cases[i].page));
    assert_null(strstr(page, cases[1 - i].page));
    free(page);
  }
}

// The slow penny-farthing's steer jumps; the roadster's does not at the speeds drawn.
static void an_end_of_contours_is_drawn(void **state) {
  (void)state;
  static const char dotted[] = "<path class=\"dotted\"", words[] = "Dotted: across it";
  run_well("bicycle figures penny_farthing -o torn --speeds 0.5:3:51 --leans 0:10deg:41" SMALL);
  run_well("bicycle figures roadster -o whole --speeds 2:10:41 --leans 0:30deg:31" SMALL);
  static const char *const panels[] = {"fig2a", "fig2b", "fig2c", "fig2d"};
  for (int i = 0; i < 4; i++) {
    char torn[32], whole[32];
    snprintf(torn, sizeof torn, "torn/%s.svg", panels[i]);
    snprintf(whole, sizeof whole, "whole/%s.svg", panels[i]);
    expect_caption(torn, words, true);
    expect_caption(whole, words, false);
    char *with = run_read(torn), *without = run_read(whole);
    assert_int_equal(run_occurrences(with, dotted), 1);
    assert_int_equal(run_occurrences(without, dotted), 0);
    free(with);
    free(without);
  }
}

static void keys_name_what_is_drawn(void **state) {
  (void)state;
  run_well("bicycle figures roadster_riderless -o keys --inertia 0:0.5:21 --trail 0:0.16:21");
  char *inertia = run_read("keys/fig3.svg"), *trail = run_read("keys/fig4.svg");
  assert_int_equal(run_occurrences(inertia, ">limits, "), 2);
  assert_int_equal(run_occurrences(trail, ">limits, fork fixed in space<"), 1);
  assert_int_equal(run_occurrences(trail, ">limits, fork fixed to the axis<"), 0);
  expect_caption("keys/fig4.svg", "Never stable: fork fixed to the axis.", true);
  free(inertia);
  free(trail);
}

// Every part of the map can be seen: the key stands between the frame, which ends at 418, and the
// caption.
static void a_map_is_not_covered_by_its_key(void **state) {
  (void)state;
  run_well("bicycle basin roadster --speed 5.8 --time 20 --leans -30deg:30deg:5 --steers "
           "-30deg:30deg:5 -o basin.svg");
  char *svg = run_read("basin.svg");
  const char *caption = strstr(svg, "<text class=\"caption\"");
  double caption_y, y;
  int entries = 0;
  assert_int_equal(sscanf(strstr(caption, "y=\""), "y=\"%lf", &caption_y), 1);
  for (const char *at = svg; (at = strstr(at, "<text class=\"on\" x=")); at++) {
    assert_int_equal(sscanf(strstr(at, " y=\""), " y=\"%lf", &y), 1);
    assert_true(y > 418 + 48 && y < caption_y - 12);
    entries++;
  }
  assert_true(entries >= 2);
  free(svg);
}

static void a_negative_length_has_a_minus_sign(void **state) {
  (void)state;
  run_well("bicycle draw penny_farthing -o penny.svg");
  char *svg = run_read("penny.svg");
  assert_non_null(strstr(svg, "= \u22120.3035 m"));
  assert_null(strstr(svg, "= -"));
  free(svg);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(captions_name_the_bicycle),
      cmocka_unit_test(the_sense_of_the_steer_is_told),
      cmocka_unit_test(an_end_of_contours_is_drawn),
      cmocka_unit_test(keys_name_what_is_drawn),
      cmocka_unit_test(a_map_is_not_covered_by_its_key),
      cmocka_unit_test(a_negative_length_has_a_minus_sign),
  };
  return cmocka_run_group_tests(tests, run_enter_group, run_leave_group);
}
