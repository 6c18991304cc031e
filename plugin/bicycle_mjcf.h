// SPDX-License-Identifier: Apache-2.0
// A bicycle as a MuJoCo model: MJCF text from any bike_bicycle, and the compiled mjModel.
//
// Bodies rear_frame > rear_wheel and rear_frame > front_frame > front_wheel; at qpos = 0 the
// bicycle stands upright and unsteered, every body frame is (forward, left, up), the origin of
// rear_frame is the rear hub and that of front_frame the foot of the perpendicular from the front
// hub onto the steering axis (the paper's x0 = 0). Joints, all about axes of their body:
//   x, y, z     slides of the rear hub from (0, 0, R_r)      root MJCF_ROOT_HINGE
//   yaw, roll, pitch   about +z, +x, +y: left, right, nose down
//   root        the free joint                               root MJCF_ROOT_FREE
//   steer       about the upward steering axis: left
//   rear_spin, front_spin   about +y: rolling forward
//   rider       slide to the right of body rider, on the rear frame; with a moving rider only. Its
//               work is the activation of actuator rolling:rider:work
// so that lean = roll, and the paper's speed is v = R_r (pitch' + rear_spin').
#ifndef BICYCLE_MJCF_H
#define BICYCLE_MJCF_H

#include <bicycle/bicycle.h>
#include <bicycle/state.h>
#include <mujoco/mujoco.h>

// Joints of the root. MuJoCo's RK4 is of order 4 with hinges, only of order 2 with a free joint.
typedef enum mjcf_root { MJCF_ROOT_HINGE, MJCF_ROOT_FREE } mjcf_root;

// Who keeps the wheels on the ground: the exact rolling constraint (plugin/rolling.h) on thin
// discs, or MuJoCo's own soft contacts of 1 mm thin ellipsoids.
typedef enum mjcf_rolling { MJCF_ROLLING_EXACT, MJCF_ROLLING_CONTACT } mjcf_rolling;

typedef enum mjcf_integrator { MJCF_RK4, MJCF_EULER, MJCF_IMPLICIT } mjcf_integrator;

typedef struct mjcf_options {
  mjcf_root root;             //
  mjcf_rolling rolling;       //
  mjcf_integrator integrator; //
  double timestep;            // s   > 0
  double contact_time;        // s   time constant of contacts (solref); 0: two timesteps, which is
                              //     the least that MuJoCo takes
  double rider_offset;        // m   the rider sits this far to the right of the place in the file
  bool moving_rider;          //     the rider, on a slide to the right, is a driven joint
                              //     (rolling.h) that follows userdata 0..2; exact rolling only
  bool visible;               //     with geometry that looks like a bicycle, lights, cameras
} mjcf_options;

// Hinge root, exact rolling, RK4 with 1 ms, rider sitting still at his place, visible.
mjcf_options mjcf_default_options(void);

// What went wrong, in one line without a full stop.
enum { MJCF_TEXT_SIZE = 512 };
typedef struct mjcf_error {
  char text[MJCF_TEXT_SIZE];
  bool no_memory; // and nothing else is to blame
} mjcf_error;

// Writes printf-like text into the error; returns false, so that one can return what it returns.
bool mjcf_fail(mjcf_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool mjcf_fail_memory(mjcf_error *error); // "out of memory"

// The state of the keyframe `test`, from which mujoco-testspeed and the plugin start.
enum { MJCF_MAX_QPOS = 11, MJCF_MAX_QVEL = 10 };
typedef struct mjcf_key {
  double qpos[MJCF_MAX_QPOS]; // nq = 9 (hinge root) or 10, one more with a moving rider
  double qvel[MJCF_MAX_QVEL]; // nv = 9, or 10
} mjcf_key;

// MJCF of the bicycle, every number with 17 digits; free() it. `key` may be NULL: no keyframe.
// NULL with a text in `error` if the bicycle breaks a rule (bike_check), if there is no rider to
// displace or move, or if MuJoCo cannot hold it (a wheel without inertia about its axle).
char *mjcf_text(const bike_bicycle *bicycle, const mjcf_options *options, const mjcf_key *key,
                mjcf_error *error);

// The same bicycle in the manner of google-deepmind/mujoco_menagerie, model and scene apart: a file
// with default classes (visual, collision, wheel), a motor on the steer and sensors, and a scene
// that includes `model_file`, with ground, light, sky and a camera. Their sensors:
//   steer, steer_rate; lean, lean_rate, speed (hinge root: joints and a fixed tendon)
//   left_axis, hub_velocity   (free root: sin(lean) is the z of the first)
//   rolling:model:energy      (rolling.h)
// The compiled bodies and the ride are those of mjcf_text.
char *mjcf_model_text(const bike_bicycle *bicycle, const mjcf_options *options, const mjcf_key *key,
                      mjcf_error *error);
char *mjcf_scene_text(const bike_bicycle *bicycle, const char *model_file, mjcf_error *error);

// What the README.md beside those two says of their origin.
typedef struct mjcf_origin {
  const char *name;    // of the files: NAME.xml, NAME.png
  const char *source;  // the bicycle file beside them
  const char *command; // that made them
  const char *version; // of this project
  bool shipped;        // the bicycle is one of this project's
  bool picture;        // there is a NAME.png
  bike_state start;    // of the keyframe
} mjcf_origin;

// README.md: what the model is, how to use it, its parameters with their origin, licence. free()
// it.
char *mjcf_readme_text(const bike_bicycle *bicycle, const mjcf_options *options,
                       const mjcf_origin *origin, mjcf_error *error);

// How many bodies of the bicycle, made with these options, have a tensor which MJCF refuses (a
// principal moment above the sum of the other two, or zero): the text holds a legal placeholder for
// these, and the exact tensor in <custom><numeric name="inertia:BODY" data="Ixx Iyy Izz Ixy Ixz
// Iyz"/>.
int mjcf_placeholder_count(const bike_bicycle *bicycle, const mjcf_options *options);

// Compiles MJCF text, or the file (.xml or .mjb), and applies exact tensors (below). NULL with a
// text in `error`, also where a custom element looks like a marker of rolling.h and is none
// (ROLL_BAD_NAME); never exits. The compiler of MuJoCo 2.2 keeps its last model globally: threads
// that call these wait for each other.
mjModel *mjcf_compile(const char *text, mjcf_error *error);
mjModel *mjcf_compile_scene(const char *scene, const char *model_file, const char *model,
                            mjcf_error *error); // text, and name and text of what it includes
mjModel *mjcf_load(const char *path, mjcf_error *error);

// mjcf_text and mjcf_compile in one.
mjModel *mjcf_model(const bike_bicycle *bicycle, const mjcf_options *options, const mjcf_key *key,
                    mjcf_error *error);

// Replaces the tensor of every body BODY for which the model has a numeric "inertia:BODY" and
// updates what MuJoCo derives from it. False if a numeric does not fit: no such body, not six
// numbers, not positive semidefinite.
bool mjcf_apply_inertia(mjModel *model, mjcf_error *error);

// Inertia tensor (Ixx, Iyy, Izz, Ixy, Ixz, Iyz) of a body about its centre of mass in the axes of
// the body, as the compiled model holds it.
void mjcf_body_inertia(double out[6], const mjModel *model, int body);

#endif
