// SPDX-License-Identifier: Apache-2.0
#include "motion/ride_vector.h"

#include <math.h>

#include "motion/ride_flow.h"
#include "motion/vector.h"

static realtype *data_of(N_Vector v) {
  return NV_DATA_S(v);
}

// z = a x + b y; z may be one of them.
static void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  const realtype *from = data_of(x), *other = data_of(y);
  realtype *to = data_of(z);
  for (int i = 0; i < RIDE_SIZE; i++) to[i] = a * from[i] + b * other[i];
}

static void scale(realtype c, N_Vector x, N_Vector z) {
  const realtype *from = data_of(x);
  realtype *to = data_of(z);
  for (int i = 0; i < RIDE_SIZE; i++) to[i] = c * from[i];
}

// z = sum c_j x_j; z may be x_0. A third of the tables' coefficients are zero.
static int linear_combination(int count, realtype *c, N_Vector *x, N_Vector z) {
  realtype sum[RIDE_SIZE] = {0};
  for (int j = 0; j < count; j++) {
    if (c[j] == 0) continue;
    const realtype *from = data_of(x[j]);
    for (int i = 0; i < RIDE_SIZE; i++) sum[i] += c[j] * from[i];
  }
  realtype *to = data_of(z);
  for (int i = 0; i < RIDE_SIZE; i++) to[i] = sum[i];
  return 0;
}

static realtype weighted_norm(N_Vector x, N_Vector w) {
  const realtype *of = data_of(x), *by = data_of(w);
  realtype sum = 0;
  for (int i = 0; i < RIDE_SIZE; i++) sum += (of[i] * by[i]) * (of[i] * by[i]);
  return sqrt(sum / RIDE_SIZE);
}

N_Vector ride_vector_over(realtype *data, SUNContext context) {
  N_Vector v = vector_create(RIDE_SIZE, context);
  if (!v) return NULL;
  NV_DATA_S(v) = data;
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvscale = scale;
  v->ops->nvwrmsnorm = weighted_norm;
  v->ops->nvlinearcombination = linear_combination;
  return v;
}
