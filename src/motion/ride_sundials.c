// SPDX-License-Identifier: Apache-2.0
#include "motion/ride_sundials.h"

#include <bicycle/error.h>
#include <math.h>
#include <string.h>

#include "motion/ride_vector.h"

int ride_sundials_open(ride_sundials *out, const bike_ride_def *def, const ride_point *start,
                       ride_flow *flow) {
  *out = (ride_sundials){.flow = flow, .rtol = def->rtol, .atol = def->atol};
  if (SUNContext_Create(NULL, &out->context)) return BIKE_ERROR_MEMORY;
  out->y = ride_vector_over(out->data, out->context);
  if (!out->y) return BIKE_ERROR_MEMORY;
  ride_sundials_put(out, start);
  return BIKE_OK;
}

void ride_sundials_close(ride_sundials *s) {
  if (s->y) N_VDestroy(s->y);
  if (s->context) SUNContext_Free(&s->context);
}

void ride_sundials_put(ride_sundials *s, const ride_point *from) {
  memcpy(s->data, from->y, sizeof s->data);
}

void ride_sundials_get(ride_point *out, const ride_sundials *s, double t) {
  out->t = t;
  memcpy(out->y, s->data, sizeof s->data);
}

int ride_sundials_code(const ride_sundials *s, int code) {
  const int no_memory = -20; // ARK_MEM_FAIL, CV_MEM_FAIL
  if (code == no_memory || vector_ran_out(s->y)) return BIKE_ERROR_MEMORY;
  return code < 0 ? code : BIKE_OK;
}

int ride_sundials_rates(realtype t, N_Vector y, N_Vector dy, void *user) {
  const ride_sundials *s = user;
  int failed = ride_rates(NV_DATA_S(dy), t, NV_DATA_S(y), s->flow);
  return failed > 1 ? -1 : failed;
}

int ride_sundials_weights(N_Vector y, N_Vector weights, void *user) {
  const ride_sundials *s = user;
  const double *of = NV_DATA_S(y);
  double *to = NV_DATA_S(weights);
  for (int i = 0; i < RIDE_SIZE; i++) to[i] = 1 / (s->rtol * fabs(of[i]) + s->atol);
  return 0;
}

void ride_sundials_quiet(int code, const char *module, const char *function, char *text,
                         void *user) {
  (void)code, (void)module, (void)function, (void)text, (void)user;
}
