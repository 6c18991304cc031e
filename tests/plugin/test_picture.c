// SPDX-License-Identifier: Apache-2.0
// Pictures: of the size asked for, with all that moves in them and centred, wherever it is; and a
// clear word where there is no OSMesa.
#include "picture.h"
#include "support/near.h"

#include <dlfcn.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

//---------------------------------- a machine without OSMesa --------------------------------------

static bool osmesa_is_missing;

// Linked in place of dlopen (--wrap).
void *__real_dlopen(const char *name, int flags);
void *__wrap_dlopen(const char *name, int flags);
void *__wrap_dlopen(const char *name, int flags) {
  bool is_osmesa = name && strstr(name, "OSMesa");
  return osmesa_is_missing && is_osmesa ? NULL : __real_dlopen(name, flags);
}

//---------------------------------- pictures ------------------------------------------------------

// A red ball, free, over nothing: all that is red is the ball.
static const char ball[] =
    "<mujoco><worldbody><camera name=\"above\" pos=\"0 0 5\"/>"
    "<body name=\"ball\"><freejoint/><geom size=\"0.4\" rgba=\"1 0 0 1\"/></body>"
    "</worldbody></mujoco>";

// The same beside a second one, so that the whole is wider than high.
static const char balls[] =
    "<mujoco><worldbody><geom name=\"floor\" type=\"plane\" size=\"9 9 1\" pos=\"0 0 -0.4\"/>"
    "<body><freejoint/><geom size=\"0.4\" rgba=\"1 0 0 1\"/>"
    "<geom size=\"0.4\" pos=\"3 0 0\" rgba=\"1 0 0 1\"/></body></worldbody></mujoco>";

typedef struct pixels {
  png_image image;
  unsigned char *rgb;
} pixels;

static pixels render(const char *text, picture_size size, const char *camera, const double *at) {
  mjcf_error error = {.text = ""};
  picture_status status;
  mjModel *m = mjcf_compile(text, &error);
  if (!m) fail_msg("%s", error.text);
  picture *p = picture_create(m, size, camera, &status, &error);
  if (!p) fail_msg("%s", error.text);
  double qpos[7];
  mju_copy(qpos, m->qpos0, 7);
  if (at) mju_copy3(qpos, at);
  char *bytes = NULL;
  size_t count = 0;
  FILE *out = open_memstream(&bytes, &count);
  if (picture_write(out, p, qpos, &error) != PICTURE_OK) fail_msg("%s", error.text);
  fclose(out);
  pixels read = {.image = {.version = PNG_IMAGE_VERSION}};
  assert_true(png_image_begin_read_from_memory(&read.image, bytes, count));
  read.image.format = PNG_FORMAT_RGB;
  read.rgb = malloc(PNG_IMAGE_SIZE(read.image));
  assert_true(png_image_finish_read(&read.image, NULL, read.rgb, 0, NULL));
  free(bytes);
  picture_free(p);
  mj_deleteModel(m);
  return read;
}

// Where the red is, as shares of width and height.
typedef struct box {
  double left, right, top, bottom;
} box;

static bool is_red(const unsigned char *pixel) {
  return pixel[0] > 60 && pixel[0] > 3 * pixel[1] && pixel[0] > 3 * pixel[2];
}

static box find_red(const pixels *p) {
  int width = (int)p->image.width, height = (int)p->image.height;
  box b = {1, 0, 1, 0};
  for (int i = 0; i < width * height; i++) {
    if (!is_red(p->rgb + 3 * i)) continue;
    double x = (i % width + 0.5) / width, y = (i / width + 0.5) / height;
    b.left = fmin(b.left, x), b.right = fmax(b.right, x);
    b.top = fmin(b.top, y), b.bottom = fmax(b.bottom, y);
  }
  return b;
}

static box shoot(const char *text, picture_size size, const char *camera, const double *at) {
  pixels p = render(text, size, camera, at);
  assert_int_equal(p.image.width, size.width);
  assert_int_equal(p.image.height, size.height);
  box b = find_red(&p);
  free(p.rgb);
  return b;
}

// In the middle, filling most of what can be filled.
static void test_what_moves_is_framed(void **state) {
  (void)state;
  box one = shoot(ball, (picture_size){400, 300}, NULL, NULL);
  assert_near((one.left + one.right) / 2, 0.5, 0.02);
  assert_near((one.top + one.bottom) / 2, 0.5, 0.02);
  assert_near(one.bottom - one.top, 0.9, 0.03);
  // as many pixels wide as high
  assert_near((one.right - one.left) * 400, (one.bottom - one.top) * 300, 4);
  assert_true(one.left > 0 && one.top > 0.02 && one.bottom < 0.98);
  box upright = shoot(ball, (picture_size){300, 400}, NULL, NULL);
  assert_near(upright.right - upright.left, 0.88, 0.05); // a narrower angle
  box wide = shoot(balls, (picture_size){400, 300}, NULL, NULL);
  assert_true(wide.left > 0.02 && wide.right < 0.98 && wide.top > 0.02 && wide.bottom < 0.98);
  assert_true(wide.right - wide.left > 0.8);
}

static void test_it_is_followed(void **state) {
  (void)state;
  const double far_away[3] = {300, -400, 0};
  box near = shoot(ball, (picture_size){400, 300}, NULL, NULL);
  box far = shoot(ball, (picture_size){400, 300}, NULL, far_away);
  assert_near(far.left, near.left, 0.01);
  assert_near(far.right, near.right, 0.01);
  assert_near(far.bottom, near.bottom, 0.01);
}

// Looking down from 5 m with MuJoCo's 45 degrees: 0.4 m of radius over 2 * 5 tan(22.5 deg) m.
static void test_camera_of_the_model(void **state) {
  (void)state;
  box b = shoot(ball, (picture_size){300, 300}, "above", NULL);
  assert_near(b.right - b.left, 0.8 / (2 * 5 * tan(mjPI / 8)), 0.02);
  assert_near((b.top + b.bottom) / 2, 0.5, 0.01);
  const double aside[3] = {1, 0, 0};
  b = shoot(ball, (picture_size){300, 300}, "above", aside);
  assert_near((b.left + b.right) / 2, 0.5 + 1 / (2 * 5 * tan(mjPI / 8)), 0.02);
}

// Rows from top to bottom; what nothing is drawn on is sky, paler towards the ground.
static void test_the_sky(void **state) {
  (void)state;
  pixels p = render(ball, (picture_size){64, 64}, NULL, NULL);
  const unsigned char *top = p.rgb, *bottom = p.rgb + (size_t)3 * 64 * 63;
  assert_true(top[2] > top[0] + 30);
  assert_true(bottom[0] > top[0] + 30);
  free(p.rgb);
}

//---------------------------------- refusals ------------------------------------------------------

static void refuse(picture_size size, const char *camera, picture_status expected,
                   const char *word) {
  mjcf_error error = {.text = ""};
  picture_status status;
  mjModel *m = mjcf_compile(ball, &error);
  assert_null(picture_create(m, size, camera, &status, &error));
  assert_int_equal(status, expected);
  if (!strstr(error.text, word)) fail_msg("%s", error.text);
  mj_deleteModel(m);
}

static void test_refusals(void **state) {
  (void)state;
  refuse((picture_size){0, 0}, NULL, PICTURE_ARGUMENT, "0x0");
  refuse((picture_size){-1, 100}, NULL, PICTURE_ARGUMENT, "-1x100");
  refuse((picture_size){100, PICTURE_MOST_SIZE + 1}, NULL, PICTURE_ARGUMENT, "100x4097");
  refuse((picture_size){100, 100}, "behind", PICTURE_ARGUMENT, "no camera 'behind'");
  osmesa_is_missing = true;
  refuse((picture_size){100, 100}, NULL, PICTURE_NO_GL, "libosmesa6");
  osmesa_is_missing = false;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_refusals), // first, before OSMesa is there
      cmocka_unit_test(test_what_moves_is_framed),
      cmocka_unit_test(test_it_is_followed),
      cmocka_unit_test(test_camera_of_the_model),
      cmocka_unit_test(test_the_sky),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
