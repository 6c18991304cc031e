// SPDX-License-Identifier: Apache-2.0
// MuJoCo's abstract scene and its renderer, at twice the size: the mean of four pixels smooths
// edges against the sky too, which is put in afterwards.
#include "picture_internal.h"
#include "runner_guard.h"

#include <stdlib.h>
#include <string.h>

struct picture {
  mjModel *model;     // a copy, lit and with a buffer of the size
  mjData *data;       //
  picture_size size;  // of the rendering, twice that of the picture
  mjvCamera camera;   //
  bool frames;        // the camera is placed anew for each picture
  picture_gl *gl;     //
  mjrContext context; //
  mjvScene scene;     //
  unsigned char *rgb; //
  unsigned char *png; // rgb of the picture
  float *depth;       //
};

// What MuJoCo may complain of ends in a report.
static bool attempt(void (*function)(void *), void *argument, mjcf_error *error) {
  guard_report report;
  guard_call(&report, function, argument);
  return !report.failed || guard_fail(error, &report);
}

static void prepare_scene(void *argument) {
  enum { MOST_GEOMS = 10000 };
  picture *p = (picture *)argument;
  mjr_defaultContext(&p->context);
  mjv_defaultScene(&p->scene);
  mjv_makeScene(p->model, &p->scene, MOST_GEOMS);
  mjr_makeContext(p->model, &p->context, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_OFFSCREEN, &p->context);
}

static bool choose_camera(picture *p, const char *name, mjcf_error *error) {
  p->frames = !name;
  if (!name) return true;
  mjv_defaultCamera(&p->camera);
  p->camera.type = mjCAMERA_FIXED;
  p->camera.fixedcamid = mj_name2id(p->model, mjOBJ_CAMERA, name);
  return p->camera.fixedcamid >= 0 || mjcf_fail(error, "the model has no camera '%s'", name);
}

static bool allocate(picture *p, const mjModel *model) {
  size_t pixels = (size_t)p->size.width * (size_t)p->size.height;
  p->model = guard_copy_model(model);
  p->data = p->model ? guard_make_data(p->model) : NULL;
  p->rgb = (unsigned char *)malloc(3 * pixels);
  p->png = (unsigned char *)malloc(3 * pixels / 4);
  p->depth = (float *)malloc(sizeof *p->depth * pixels);
  return p->data && p->rgb && p->png && p->depth;
}

static picture_status prepare(picture *p, const mjModel *model, const char *camera,
                              mjcf_error *error) {
  if (!allocate(p, model)) {
    mjcf_fail(error, "out of memory for a picture");
    return PICTURE_MEMORY;
  }
  if (!choose_camera(p, camera, error)) return PICTURE_ARGUMENT;
  picture_prepare_look(p->model);
  p->model->vis.global.offwidth = p->size.width;
  p->model->vis.global.offheight = p->size.height;
  p->model->vis.quality.offsamples = 0; // the mean of four does better
  p->gl = picture_gl_create(p->size, error);
  bool works = p->gl && attempt(prepare_scene, p, error);
  return works ? PICTURE_OK : PICTURE_NO_GL;
}

static bool is_size(int pixels) {
  return pixels >= PICTURE_LEAST_SIZE && pixels <= PICTURE_MOST_SIZE;
}

picture *picture_create(const mjModel *model, picture_size size, const char *camera,
                        picture_status *status, mjcf_error *error) {
  *status = PICTURE_ARGUMENT;
  if (!is_size(size.width) || !is_size(size.height)) {
    mjcf_fail(error, "a picture of %dx%d: each must be in %d to %d", size.width, size.height,
              PICTURE_LEAST_SIZE, PICTURE_MOST_SIZE);
    return NULL;
  }
  picture *p = (picture *)calloc(1, sizeof *p);
  *status = PICTURE_MEMORY;
  if (!p) return mjcf_fail(error, "out of memory for a picture"), NULL;
  p->size = (picture_size){2 * size.width, 2 * size.height};
  *status = prepare(p, model, camera, error);
  if (*status == PICTURE_OK) return p;
  picture_free(p);
  return NULL;
}

static void free_scene(void *argument) {
  picture *p = (picture *)argument;
  mjr_freeContext(&p->context);
  mjv_freeScene(&p->scene);
}

static void free_gl(void *argument) {
  picture *p = (picture *)argument;
  picture_gl_free(p->gl);
}

void picture_free(picture *p) {
  if (!p) return;
  guard_report report;
  if (p->gl) guard_call(&report, free_scene, p);
  if (p->gl) guard_call(&report, free_gl, p); // a driver short of memory holds its locks for ever
  if (p->data) mj_deleteData(p->data);
  mj_deleteModel(p->model);
  free(p->rgb);
  free(p->png);
  free(p->depth);
  free(p);
}

//---------------------------------- rendering -----------------------------------------------------

static void place(picture *p) {
  mj_kinematics(p->model, p->data);
  mj_comPos(p->model, p->data);
  mj_camlight(p->model, p->data);
  mj_tendon(p->model, p->data);
}

static void render(void *argument) {
  picture *p = (picture *)argument;
  mjvOption options;
  const mjrRect whole = {0, 0, p->size.width, p->size.height};
  place(p);
  mjv_defaultOption(&options);
  options.flags[mjVIS_INERTIA] = !picture_has_shapes(p->model);
  const double *centre = p->data->subtree_com; // of the whole world
  if (p->frames) picture_frame(&p->camera, p->model, p->data, p->size);
  mjv_updateScene(p->model, p->data, &options, NULL, &p->camera, mjCAT_ALL, &p->scene);
  picture_light(&p->scene, p->model, centre);
  mjr_render(whole, &p->scene, &p->context);
  mjr_readPixels(p->rgb, p->depth, whole, &p->context);
}

static bool has_sky(const mjModel *m) {
  for (int i = 0; i < m->ntex; i++)
    if (m->tex_type[i] == mjTEXTURE_SKYBOX) return true;
  return false;
}

picture_status picture_write(FILE *out, picture *p, const mjtNum *qpos, mjcf_error *error) {
  mju_copy(p->data->qpos, qpos, p->model->nq);
  if (!attempt(render, p, error)) return PICTURE_NO_GL;
  if (!has_sky(p->model)) picture_fill_sky(p->rgb, p->depth, p->size);
  picture_halve(p->png, p->rgb, p->size);
  picture_size size = {p->size.width / 2, p->size.height / 2};
  if (picture_put_png(out, p->png, size)) return PICTURE_OK;
  mjcf_fail(error, "libpng cannot make a picture of this");
  return PICTURE_MEMORY;
}
