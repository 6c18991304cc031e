// SPDX-License-Identifier: Apache-2.0
// The README.md of a model with its scene.
#include "bicycle_mjcf_internal.h"

#include "files/memory_stream.h"

#include <bicycle/error.h>
#include <stdlib.h>

typedef struct page {
  FILE *out;
  const mjcf_plan *plan;
  const mjcf_origin *origin;
} page;

static bool is_exact(const page *p) {
  return p->plan->options->rolling == MJCF_ROLLING_EXACT;
}

static bool has_hinges(const page *p) {
  return p->plan->options->root == MJCF_ROOT_HINGE;
}

// Anybody's text in a cell of a table.
static void put_cell(FILE *out, const char *text) {
  for (; *text; text++) {
    if (*text == '|' || *text == '<' || *text == '`' || *text == '\\') fputc('\\', out);
    fputc((unsigned char)*text < ' ' ? '?' : *text, out);
  }
}

static void put_numbers(FILE *out, const double *numbers, int count) {
  for (int k = 0; k < count; k++) fprintf(out, "%s%.10g", k ? ", " : "", numbers[k] + 0.0);
}

static void put_head(const page *p) {
  const char *name = p->origin->name;
  fputs("# ", p->out);
  put_cell(p->out, p->plan->bicycle->name);
  fprintf(p->out, "\n\nA bicycle for MuJoCo 2.2: ");
  if (is_exact(p))
    fputs("its wheels are thin discs that roll without slipping, exactly, where\n"
          "`libmujoco_rolling.so` is loaded (elsewhere they fall through the ground).\n\n",
          p->out);
  else
    fputs("its wheels are thin ellipsoids on MuJoCo's own contacts.\n\n", p->out);
  if (p->origin->picture) fprintf(p->out, "![the bicycle](%s.png)\n\n", name);
  fputs("| file | what |\n|---|---|\n", p->out);
  fprintf(p->out,
          "| `%s.xml` | the bicycle: bodies, default classes, motor, sensors, keyframe `test` |\n",
          name);
  fputs("| `scene.xml` | includes it; ground, light, sky, a camera at the roadside |\n", p->out);
  fprintf(p->out, "| `%s` | the parameters it was made from |\n", p->origin->source);
  if (p->origin->picture) fprintf(p->out, "| `%s.png` | `scene.xml` at its keyframe |\n", name);
}

static void put_use(const page *p) {
  fputs("\n## Use\n\n```sh\nbicycle mujoco ride scene.xml --time 10 --sample 0.01 -o ride.csv\n",
        p->out);
  if (is_exact(p))
    fputs("LD_PRELOAD=libmujoco_rolling.so ROLL_KEYFRAME=test mujoco-simulate scene.xml\n", p->out);
  fputs("```\n\n", p->out);
  const bike_state *s = &p->origin->start;
  fprintf(
      p->out,
      "The keyframe `test` is a start that rolls: %.4g m/s, lean %.4g rad, steer %.4g rad, lean "
      "rate\n%.4g rad/s, steer rate %.4g rad/s. At `qpos` 0 the bicycle stands upright, its rear "
      "contact in the\norigin. SI units and radians; lean right, steer and yaw left positive; "
      "wheels grow rolling forward.\n",
      s->speed, s->lean, s->steer, s->lean_rate, s->steer_rate);
}

static void put_names(const page *p) {
  fputs("\n## Names\n\n| | |\n|---|---|\n"
        "| bodies | `rear_frame` > `rear_wheel`; `rear_frame` > `front_frame` > `front_wheel`",
        p->out);
  fputs(p->plan->options->moving_rider ? "; `rear_frame` > `rider` |\n" : " |\n", p->out);
  fputs(has_hinges(p) ? "| root | slides `x`, `y`, `z`, hinges `yaw`, `roll`, `pitch`: RK4 is of "
                        "order 4 |\n"
                      : "| root | the free joint `root`: RK4 is of order 2 |\n",
        p->out);
  fputs("| other joints | `steer`, `rear_spin`, `front_spin`", p->out);
  fputs(p->plan->options->moving_rider ? ", `rider` (driven by userdata) |\n" : " |\n", p->out);
  fputs("| default classes | `visual` (group 2), `collision` (group 3), `wheel` |\n"
        "| motor | `steer_torque`, N m, left positive |\n"
        "| sensors | `steer`, `steer_rate`",
        p->out);
  fputs(has_hinges(p) ? ", `lean`, `lean_rate`; `speed` of the rear contact along its track, "
                        "R_r (pitch' + rear_spin')"
                      : "; `left_axis`, whose z is sin(lean); `hub_velocity` of the rear hub",
        p->out);
  fputs("; `rolling:model:energy`, J, answered by `libmujoco_rolling.so` (MuJoCo 2.2 has no sensor "
        "of energy) |\n",
        p->out);
}

static void put_geometry(const page *p) {
  const bike_geometry *g = &p->plan->bicycle->geometry;
  const bike_upright *upright = &p->plan->upright;
  double degrees = 90 - upright->tilt * 180 / mjPI;
  fprintf(p->out,
          "\n## Parameters\n\n| length or angle | value |\n|---|---|\n"
          "| wheelbase | %.10g m |\n| trail | %.10g m |\n| head angle, from the horizontal | %.10g "
          "deg |\n| wheel radius, rear / front | %.10g / %.10g m |\n| gravity | %.10g m/s^2 |\n"
          "| damping of the steer | %.10g N m s/rad |\n",
          upright->wheelbase, upright->trail, degrees, g->R_r, g->R_f, p->plan->bicycle->gravity,
          p->plan->bicycle->steer_damping);
}

static void put_parts(const page *p) {
  static const char *const assemblies[] = {"rear frame", "rear wheel", "front frame",
                                           "front wheel"};
  fputs("\n| part | of | mass, kg | position, m | inertia Ixx, Iyy, Izz, Ixy, Ixz, Iyz, kg m^2 |\n"
        "|---|---|---|---|---|\n",
        p->out);
  const bike_bicycle *b = p->plan->bicycle;
  for (int i = 0; i < b->part_count; i++) {
    const bike_part *part = &b->parts[i];
    fputs("| ", p->out);
    put_cell(p->out, part->name);
    fprintf(p->out, " | %s | %.10g | ", assemblies[part->assembly], part->mass);
    put_numbers(p->out, part->position, 3);
    fputs(" | ", p->out);
    put_numbers(p->out, part->inertia, 6);
    fputs(" |\n", p->out);
  }
  fputs("\nAxes: forward of the rear contact, left, up; upright and unsteered; tensors about the "
        "part's centre\nof mass.",
        p->out);
  if (p->plan->options->rider_offset != 0)
    fprintf(p->out, " In the model the rider sits %.10g m to the right of this place.",
            p->plan->options->rider_offset);
  fputc('\n', p->out);
}

static void put_derivation(const page *p) {
  const mjcf_options *o = p->plan->options;
  static const char *const integrators[] = {"RK4", "Euler", "implicit"};
  fputs(
      "\n## How it was derived\n\nParts of one rigid assembly are lumped into one body; its tensor "
      "goes to principal axes (`quat`,\n`diaginertia`), every number with 17 digits. What is drawn "
      "weighs nothing and touches nothing: it is laid\naround the lengths above. ",
      p->out);
  fprintf(p->out, "Integrator %s, timestep %g s.\n", integrators[o->integrator], o->timestep);
  fputs("The single file of `bicycle mujoco mjcf -o X.xml` compiles to the same bodies and rides "
        "alike.\n",
        p->out);
  bool any = false;
  for (int i = 0; i < p->plan->bodies; i++) {
    if (!p->plan->body[i].placeholder) continue;
    if (!any)
      fputs("\n**Placeholders.** MJCF refuses tensors with a principal moment above the sum of the "
            "other two. The nearest\nlegal moments stand in, the exact tensor in `<numeric "
            "name=\"inertia:BODY\">`; `bicycle mujoco` puts it into the\ncompiled model, other "
            "programs see the placeholder (an `.mjb` holds the exact one for everybody):\n",
            p->out);
    any = true;
    fprintf(p->out, "\n- `%s`: ", p->plan->body[i].name);
    put_numbers(p->out, p->plan->body[i].inertia, 6);
  }
  if (any) fputc('\n', p->out);
}

static void put_origin(const page *p) {
  const mjcf_origin *origin = p->origin;
  fputs("\n## Provenance\n\n| | |\n|---|---|\n| made by | `", p->out);
  put_cell(p->out, origin->command);
  fprintf(p->out, "` (bicycle %s, MuJoCo %s) |\n", origin->version, mj_versionString());
  fprintf(p->out, "| from | `%s`, %s |\n", origin->source,
          origin->shipped ? "a bicycle of that project; the source of every number stands in its "
                            "folder `model`"
                          : "a file of the user's");
  fputs("| model | Franke, Suhr, Riess, Eur. J. Phys. 11 (1990) 116-121; Meijaard et al., Proc. R. "
        "Soc. A 463 (2007) |\n\n## Licence\n\n",
        p->out);
  fputs(origin->shipped
            ? "Apache-2.0, like the project that made it.\n"
            : "The numbers are those of the bicycle file, under its terms. What the program added, "
              "the look and the\nlayout, is Apache-2.0.\n",
        p->out);
}

char *mjcf_readme_text(const bike_bicycle *bicycle, const mjcf_options *options,
                       const mjcf_origin *origin, mjcf_error *error) {
  mjcf_plan plan;
  if (!mjcf_plan_init(&plan, bicycle, options, error)) return NULL;
  char *text = NULL;
  size_t size = 0;
  const page p = {bike_memory_stream(&text, &size), &plan, origin};
  if (!p.out) return mjcf_fail_memory(error), NULL;
  put_head(&p);
  put_use(&p);
  put_names(&p);
  put_geometry(&p);
  put_parts(&p);
  put_derivation(&p);
  put_origin(&p);
  return mjcf_end_text(p.out, &text, error);
}
