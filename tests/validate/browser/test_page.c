// SPDX-License-Identifier: Apache-2.0
// report.html in a browser, opened from disk: what a reader sees and does. Skipped, saying so,
// where there is no Chromium; an error there if BICYCLE_REQUIRE_BROWSER is set, as in tests/run.sh.
#include "../validate_support.h"
#include "devtools.h"
#include "support/near.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { SKIPPED = 77 }; // SKIP_RETURN_CODE of the test

static char *address;
static devtools *browser;

static const devtools_view wide = {1280, 900, false, true}, narrow = {400, 800, false, true};
static const devtools_view dark = {1280, 900, true, true}, narrow_dark = {400, 800, true, true};
static const devtools_view plain = {1280, 900, false, false},
                           plain_narrow = {400, 800, true, false};

static void picture(const char *name) {
  char *path = NULL;
  assert_true(asprintf(&path, "%s/%s.png", BICYCLE_PICTURES, name) > 0);
  devtools_picture(browser, path);
  free(path);
}

static void expect_silence(void) {
  if (*devtools_complaints(browser)) fail_msg("%s", devtools_complaints(browser));
}

static void expect(const char *expression) {
  if (!devtools_true(browser, expression)) fail_msg("does not hold: %s", expression);
}

// pixels(canvas): its bytes, read from a copy, as reading the canvas itself makes the browser warn.
static const char pixels[] =
    "void (window.pixels = (canvas) => { const copy = document.createElement('canvas'); "
    "copy.width = canvas.width; copy.height = canvas.height; const c = copy.getContext('2d', "
    "{willReadFrequently: true}); c.drawImage(canvas, 0, 0); return c.getImageData(0, 0, "
    "copy.width, copy.height).data; })";

static void open_page(const devtools_view *view) {
  devtools_open(browser, address, view);
  if (view->scripts) devtools_wait(browser, "document.documentElement.dataset.ready === 'yes'");
  if (view->scripts) json_decref(devtools_evaluate(browser, pixels));
}

// Nothing sticks out sideways.
static void expect_fitting(void) {
  expect("document.documentElement.scrollWidth <= window.innerWidth");
}

//---------------------------------- without scripts -----------------------------------------------

static void check_plain(const devtools_view *view, const char *name) {
  open_page(view);
  expect("document.querySelector('h1').textContent.startsWith('Agree')");
  expect("document.querySelectorAll('.scenario').length === 4");
  expect("[...document.querySelectorAll('.scenario')].every((s) => s.offsetHeight > 0 && "
         "s.querySelectorAll('.static svg').length >= 5)");
  expect("[...document.querySelectorAll('svg')].every((s) => s.getBoundingClientRect().width > 0)");
  expect("document.querySelectorAll('.slope').length >= 2"); // triangles of the convergence plots
  expect("document.querySelectorAll('table.sortable tbody tr').length > 100");
  expect("!document.querySelector('canvas')");
  expect_fitting();
  expect_silence();
  picture(name);
}

static void test_without_scripts(void **state) {
  (void)state;
  check_plain(&plain, "plain-wide-light");
  check_plain(&plain_narrow, "plain-narrow-dark");
}

//---------------------------------- with scripts --------------------------------------------------

// Every line of every plot is drawn: pixels of its colour, but for lines with nothing to show.
static const char plots_drawn[] =
    "(() => { const like = (p, line) => { const c = parseInt(cssColor(line.color).slice(1), 16); "
    "return [...p.box.querySelectorAll('canvas')].some((v) => { const d = pixels(v); let n = 0; "
    "for (let i = 0; i < d.length; i += 4) n += d[i + 3] > 100 && Math.abs(d[i] - (c >> 16)) + "
    "Math.abs(d[i + 1] - (c >> 8 & 255)) + Math.abs(d[i + 2] - (c & 255)) < 90; return n > 40; }); "
    "}; const shown = (line) => [...line.values].some((v) => Math.abs(v) > 1e-17); "
    "return [...explorers.values()].filter((e) => e).every((e) => e.plots.length >= 5 && "
    "e.plots.every((p) => p.what.lines.filter(shown).every((l) => like(p, l)))); })()";

static const char replay_drawn[] =
    "(() => { const d = pixels(document.querySelector('.shown .stage canvas')); let n = 0; "
    "for (let i = 3; i < d.length; i += 4) n += d[i] > 128; return n > 3000; })()";

static void check_scripted(const devtools_view *view, const char *name) {
  open_page(view);
  expect(
      "[...document.querySelectorAll('.scenario')].filter((s) => s.offsetHeight > 0).length === 1");
  expect(plots_drawn);
  devtools_wait(browser, replay_drawn);
  expect("getComputedStyle(document.querySelector('.shown .static')).display === 'none'");
  expect_fitting();
  expect_silence();
  picture(name);
}

static void test_with_scripts(void **state) {
  (void)state;
  check_scripted(&wide, "wide-light");
  expect("getComputedStyle(document.body).backgroundColor === 'rgb(255, 255, 255)'");
  check_scripted(&narrow, "narrow-light");
  check_scripted(&narrow_dark, "narrow-dark");
  check_scripted(&dark, "wide-dark");
  expect("getComputedStyle(document.body).backgroundColor !== 'rgb(255, 255, 255)'");
}

// What each plot and the replay look like now, to be compared later.
static const char remember[] =
    "void (window.before = [...document.querySelectorAll('.shown canvas')].map((c) => "
    "c.toDataURL()))";
static const char all_changed[] =
    "(() => { const now = [...document.querySelectorAll('.shown .live canvas')].map((c) => "
    "c.toDataURL()); const figures = [...document.querySelectorAll('.shown .live figure')]; "
    "return figures.every((f) => [...f.querySelectorAll('canvas')].some((c) => "
    "!window.before.includes(c.toDataURL()))); })()";

static void test_cursor_moves_everything(void **state) {
  (void)state;
  open_page(&wide);
  devtools_wait(browser, replay_drawn);
  json_decref(devtools_evaluate(browser, remember));
  devtools_point(browser, ".shown .plot", 0.6, false);
  devtools_wait(browser, all_changed);
  expect("(() => { const e = explorers.get('roadster_far'), r = e.group.row; return r > 300 && r < "
         "800 && e.replay.drawn === r && Number(e.slider.value) === r && e.plots.every((p) => "
         "p.values.textContent.includes(formatNumber(p.what.lines[0].values[r]))); })()");
  devtools_point(browser, ".shown .plot", 0.3, true); // sets cursor A
  devtools_wait(browser, "explorers.get('roadster_far').group.mark > 0");
  devtools_point(browser, ".shown .plot", 0.8, false);
  devtools_wait(browser, "document.querySelector('.shown .readout').textContent.includes('B-A')");
  picture("cursors");
  expect_silence();
}

static void test_zoom_is_shared(void **state) {
  (void)state;
  open_page(&wide);
  json_decref(devtools_evaluate(
      browser,
      "void explorers.get('roadster_far').plots[0].graph.updateOptions({dateWindow: [2, 4]})"));
  json_decref(
      devtools_evaluate(browser, "void explorers.get('roadster_far').plots[0].zoomed(2, 4)"));
  expect("explorers.get('roadster_far').plots.every((p) => { const [a, b] = p.graph.xAxisRange(); "
         "return a === 2 && b === 4; })");
  expect_silence();
}

static void test_play_and_magnify(void **state) {
  (void)state;
  open_page(&wide);
  double row = devtools_number(browser, "explorers.get('roadster_far').group.row");
  devtools_point(browser, ".shown .bar button", 0.5, true);
  char moved[128];
  snprintf(moved, sizeof moved, "explorers.get('roadster_far').group.row > %g", row + 20);
  devtools_wait(browser, moved);
  devtools_point(browser, ".shown .bar button", 0.5, true);
  expect("explorers.get('roadster_far').replay.magnify > 1e3"); // some 1e-11 rad made visible
  expect("(() => { const m = document.querySelector('.shown .magnify'), e = "
         "explorers.get('roadster_far'); m.value = 0; m.dispatchEvent(new Event('input')); return "
         "e.replay.magnify === 1; })()");
  expect_silence();
}

static void test_sorting(void **state) {
  (void)state;
  open_page(&wide);
  static const char margins[] =
      "window.margins = () => [...document.querySelectorAll('.shown .tall tbody tr')].map((r) => "
      "sortKey(r.cells[1])).filter((v) => typeof v === 'number'); "
      "window.rising = () => margins().every((v, i, all) => !i || all[i - 1] <= v); "
      "window.falling = () => margins().every((v, i, all) => !i || all[i - 1] >= v); "
      "margins().length > 50 && rising()"; // the worst one first, as the program wrote it
  expect(margins);
  devtools_point(browser, ".shown .tall th:nth-child(4)", 0.5, true); // by signal
  expect("!rising() && !falling()");
  devtools_point(browser, ".shown .tall th:nth-child(2)", 0.5, true);
  expect("rising() && document.querySelector('.shown .tall th:nth-child(2)').getAttribute("
         "'aria-sort') === 'ascending'");
  devtools_point(browser, ".shown .tall th:nth-child(2)", 0.5, true);
  expect("falling()");
  expect_silence();
}

// Opens a scenario by the link in the overview.
static void open_linked_scenario(const char *name, const char *link) {
  char text[96];
  open_page(&wide);
  snprintf(text, sizeof text, ".overview a[href='#%s']", link);
  devtools_point(browser, text, 0.5, true);
  snprintf(text, sizeof text, "Boolean(explorers.get('%s'))", name);
  devtools_wait(browser, text);
}

static void open_scenario(const char *name) {
  open_linked_scenario(name, name);
}

static void test_other_scenario(void **state) {
  (void)state;
  open_scenario("convergence_rk4");
  expect("document.querySelector('.shown').id === 'convergence_rk4'");
  expect(plots_drawn);
  expect("document.querySelectorAll('.shown .slope').length >= 2");
  expect("['right-hand sides evaluated', 'processor time, s'].every((t) => "
         "document.querySelector('.shown').textContent.includes(t))");
  expect_silence();
  picture("convergence");
}

// A reference of 3 s and a candidate of 10 s: what is left is the candidate's.
static void test_longer_candidate_is_shown_whole(void **state) {
  (void)state;
  open_linked_scenario("50%25 #1?", "50%2525%20%231%3F"); // a name full of marks of addresses
  expect(plots_drawn);
  expect(
      "(() => { const d = explorers.get('50%25 #1?').data, a = d.column('reference', 'lean'), b = "
      "d.candidate('lean'); return d.rows === 1001 && Number.isFinite(a[300]) && "
      "a.slice(301).every(Number.isNaN) "
      "&& b.every(Number.isFinite) && Math.abs(b[300] - a[300]) < 1e-6 && Math.abs(b[301] - "
      "b[300]) < 0.01; })()");
  json_decref(devtools_evaluate(browser, "void explorers.get('50%25 #1?').group.set('row', 900)"));
  devtools_wait(browser, "explorers.get('50%25 #1?').replay.drawn === 900");
  expect("(({has}) => !has[0][900] && has[1][900])(explorers.get('50%25 #1?').replay)");
  picture("longer");
}

// A wheel that rolls alone: no bicycle is drawn about it.
static void test_wheel_alone(void **state) {
  (void)state;
  open_scenario("disc");
  expect(plots_drawn);
  expect("explorers.get('disc').data.geometry.wheel_only");
  json_decref(devtools_evaluate(browser, "void explorers.get('disc').group.set('row', 250)"));
  devtools_wait(browser, "explorers.get('disc').replay.drawn === 250");
  expect_silence();
  picture("disc");
}

//---------------------------------- the data in it ------------------------------------------------

// The wheels stand on the ground wherever the replay draws them: the page's kinematics agree with
// the traces. Pitch is rounded to 1e-8 rad there.
static void test_replay_stands_on_the_ground(void **state) {
  (void)state;
  open_page(&wide);
  double height = devtools_number(
      browser, "Math.max(...explorers.get('roadster_far').replay.tracks[0].front.map((p) => "
               "Math.abs(p[2])))");
  assert_near(height, 0, 1e-6);
  expect("explorers.get('roadster_far').replay.tracks[0].rear.length === 1001");
  expect("Math.abs(explorers.get('roadster_far').replay.pose(0, 0).tubes.length) === 4");
}

// A column of a CSV file of the report at a row.
static double csv_value(const char *name, const char *column, int row) {
  char *path = NULL;
  assert_true(asprintf(&path, "%s/report/%s", support_home, name) > 0);
  double value = support_csv_value(path, column, row);
  free(path);
  return value;
}

static double page_value(const char *side, const char *column, int row) {
  char expression[256];
  snprintf(expression, sizeof expression,
           "explorers.get('roadster_far').data.column('%s', '%s')[%d]", side, column, row);
  return devtools_number(browser, expression);
}

static void test_data_is_that_of_the_files(void **state) {
  (void)state;
  static const char *const columns[] = {"x",          "yaw",    "lean",
                                        "steer_rate", "energy", "front_force_up"};
  open_page(&wide);
  for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
    for (int row = 0; row <= 1000; row += 125) {
      double value = csv_value("roadster_far-analytic.csv", columns[i], row);
      double residual = csv_value("roadster_far-residuals.csv", columns[i], row);
      // 24 bits of a range that is at most some times the value at the start
      assert_near(page_value("reference", columns[i], row), value, 1e-6 * fmax(1, fabs(value)));
      // 16 bits of a logarithm: 0.26 % between steps
      assert_near(page_value("residual", columns[i], row), residual, 0.0014 * fabs(residual));
    }
  }
  double drift = csv_value("roadster_far-mujoco.csv", "rear_slip", 500);
  assert_near(page_value("mujoco", "rear_slip", 500), drift, 0.0014 * fabs(drift));
}

static void test_json_is_that_of_the_file(void **state) {
  (void)state;
  open_page(&wide);
  json_t *held = devtools_evaluate(
      browser, "inflate(document.getElementById('/report-json').textContent).then((b) => new "
               "TextDecoder().decode(b))");
  char *text = support_output("report/report.json");
  text[strlen(text) - 1] = '\0'; // its last line feed
  assert_string_equal(json_string_value(held), text);
  json_decref(held);
  free(text);
}

// True if doing something breaks that directive of the page's policy.
static void expect_violation(const char *doing, const char *directive) {
  char *expression = NULL;
  assert_true(asprintf(&expression,
                       "new Promise((done) => { document.addEventListener("
                       "'securitypolicyviolation', (e) => done(e.effectiveDirective === '%s'), "
                       "{once: true}); setTimeout(() => done(false), 2000); %s })",
                       directive, doing) > 0);
  expect(expression);
  free(expression);
}

// A page that asks for something does not get it, nor does a script that is not ours run.
static void test_policy_is_in_force(void **state) {
  (void)state;
  open_page(&wide);
  expect_violation("fetch('https://nowhere.invalid/').catch(() => 0);", "connect-src");
  expect_violation("new Image().src = 'data:image/gif;base64,R0lGODlhAQABAAAAACw=';", "img-src");
  expect_violation("const s = document.createElement('script'); s.textContent = 'window.strange = "
                   "1'; document.body.append(s);",
                   "script-src-elem");
  expect("window.strange === undefined");
}

static void test_page_is_small(void **state) {
  struct stat status;
  (void)state;
  assert_int_equal(stat(address + strlen("file://"), &status), 0);
  assert_true(status.st_size < 1000000);
}

//---------------------------------- set-up --------------------------------------------------------

// The ride of roadster_far, of which the reference has recorded 3 s.
static const char longer[] =
    "title: longer\nbicycle: roadster\n"
    "start: {speed: 6, lean: 0.3490658503988659, steer: -0.29670597283903605}\n"
    "duration: 10\nsample: 0.01\nreference: {engine: file, file: short.csv}\n"
    "candidate: {engine: mujoco}\ngates:\n"
    "  - {layer: L2, metric: max, signals: [lean], limit: 1e-9, reason: test}\n"
    "  - {layer: L2, metric: difference, signals: [end_time], info: true, reason: test}\n";

#define PROGRAM BICYCLE_BINARY_DIR "/bin/bicycle-validate "

static int begin(void **state) {
  char *command = NULL, *profile = NULL;
  support_enter(state);
  free(support_write(support_home, "50%25 #1?.yml", longer));
  assert_true(asprintf(&command,
                       "cd %s && exec >out 2>&1 && " PROGRAM "roadster_far -o first && head -n 302 "
                       "first/roadster_far-analytic.csv >short.csv && " PROGRAM
                       "roadster_far convergence_rk4 disc '50%%25 #1?.yml' -o report",
                       support_home) > 0);
  assert_int_equal(system(command), 0);
  assert_true(asprintf(&address, "file://%s/report/report.html", support_home) > 0);
  assert_true(asprintf(&profile, "%s/profile", support_home) > 0);
  mkdir(BICYCLE_PICTURES, 0777);
  browser = devtools_start(BICYCLE_CHROMIUM, profile);
  free(command);
  free(profile);
  return 0;
}

static int end(void **state) {
  devtools_stop(browser);
  support_leave(state);
  free(address);
  return 0;
}

int main(void) {
  if (!*BICYCLE_CHROMIUM) {
    const char *required = getenv("BICYCLE_REQUIRE_BROWSER");
    print_message("SKIPPED: no Chromium was found when the build was configured\n");
    return required && *required ? 1 : SKIPPED;
  }
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_without_scripts),
      cmocka_unit_test(test_with_scripts),
      cmocka_unit_test(test_cursor_moves_everything),
      cmocka_unit_test(test_zoom_is_shared),
      cmocka_unit_test(test_play_and_magnify),
      cmocka_unit_test(test_sorting),
      cmocka_unit_test(test_other_scenario),
      cmocka_unit_test(test_longer_candidate_is_shown_whole),
      cmocka_unit_test(test_wheel_alone),
      cmocka_unit_test(test_replay_stands_on_the_ground),
      cmocka_unit_test(test_data_is_that_of_the_files),
      cmocka_unit_test(test_json_is_that_of_the_file),
      cmocka_unit_test(test_policy_is_in_force),
      cmocka_unit_test(test_page_is_small),
  };
  return cmocka_run_group_tests(tests, begin, end);
}
