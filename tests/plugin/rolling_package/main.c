// SPDX-License-Identifier: Apache-2.0
// host MODEL: starts from the first keyframe, steps for a second, says how well the discs rolled.
#include <math.h>
#include <rolling.h>
#include <stdio.h>

enum { MOST = 8 };

int main(int argc, char **argv) {
  char text[500] = "MODEL is missing";
  mjModel *m = argc == 2 ? mj_loadXML(argv[1], NULL, text, sizeof text) : NULL;
  if (!m) {
    fprintf(stderr, "%s\n", text);
    return 2;
  }
  mjData *d = mj_makeData(m);
  mj_resetDataKeyframe(m, d, 0);
  while (d->time < 1) mj_step(m, d);
  mj_forward(m, d);
  roll_disc disc[MOST];
  int count = roll_disc_count(m), wrong = !roll_is_installed() || count < 1 || count > MOST;
  roll_error error = wrong ? ROLL_OK : roll_discs(disc, count, m, d);
  for (int i = 0; !wrong && !error && i < count; i++) {
    printf("%s: height %.1e m, normal force %.3f N\n", disc[i].name, disc[i].height,
           disc[i].normal_force);
    wrong = !(fabs(disc[i].height) < 1e-11);
  }
  if (error) fprintf(stderr, "%s\n", roll_error_string(error));
  mj_deleteData(d);
  mj_deleteModel(m);
  return wrong || error;
}
