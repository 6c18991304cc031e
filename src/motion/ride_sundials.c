// SPDX-License-Identifier: Apache-2.0
#include "motion/ride_sundials.h"

#include <bicycle/error.h>
#include <string.h>

int ride_sundials_open(ride_sundials *out, const ride_point *start) {
  if (SUNContext_Create(NULL, &out->context)) return BIKE_ERROR_MEMORY;
  out->y = N_VMake_Serial(RIDE_SIZE, out->data, out->context);
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

int ride_sundials_rates(realtype t, N_Vector y, N_Vector dy, void *flow) {
  int failed = ride_rates(NV_DATA_S(dy), t, NV_DATA_S(y), flow);
  return failed > 1 ? -1 : failed;
}

void ride_sundials_quiet(int code, const char *module, const char *function, char *text,
                         void *user) {
  (void)code, (void)module, (void)function, (void)text, (void)user;
}
