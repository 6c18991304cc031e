// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_newton.h"

#include "motion/vector.h"

#include <kinsol/kinsol.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

// KINSOL's defaults, 6e-6 for the residuals, are far too loose. Residuals, rad/s^2, are sums of
// terms of 10 to 100, whose rounding this is; where a bicycle steers with less inertia than
// upright, accelerations are a hundred times as large.
static const double SMALLEST_RESIDUAL = 1e-14;
// Steps of unknowns of the order of one: below this they change nothing but the last digits.
static const double SMALLEST_STEP = 1e-15;
// Quadratic convergence needs five iterations from three digits; at a fold, where the Jacobian is
// singular, each iteration gains but one bit.
static const int ITERATIONS = 30;
// A Jacobian costs as much as ten residuals and serves three steps, each of which gains as many
// digits as the first.
static const int JACOBIAN_LIFE = 3;
// Guesses come from a neighbouring solution: a step as long as this has lost its way.
static const double LONGEST_STEP = 1.0;

// Of one search: five times what the longest one seen takes.
enum { MOST_SOLVES = 40000 };

struct newton {
  int size, solves;
  SUNContext context;
  void *kinsol;
  N_Vector x, scale;
  SUNMatrix matrix;
  SUNLinearSolver linear;
  newton_function *function;
  const void *user;
};

static int system_function(N_Vector x, N_Vector f, void *data) {
  const newton *s = data;
  double values[NEWTON_MAX];
  if (s->function(values, NULL, NV_DATA_S(x), s->user)) return 1;
  for (int i = 0; i < s->size; i++)
    if (!isfinite(values[i])) return 1;
  memcpy(NV_DATA_S(f), values, (size_t)s->size * sizeof values[0]);
  return 0;
}

static int jacobian_function(N_Vector x, N_Vector f, SUNMatrix J, void *data, N_Vector a,
                             N_Vector b) {
  (void)f, (void)a, (void)b;
  const newton *s = data;
  double values[NEWTON_MAX], rows[NEWTON_MAX][NEWTON_MAX];
  if (s->function(values, rows, NV_DATA_S(x), s->user)) return 1;
  for (int i = 0; i < s->size; i++)
    for (int j = 0; j < s->size; j++) SM_ELEMENT_D(J, i, j) = rows[i][j];
  return 0;
}

static void quiet_error(int code, const char *module, const char *function, char *text,
                        void *user) {
  (void)code, (void)module, (void)function, (void)text, (void)user;
}

static void quiet_info(const char *module, const char *function, char *text, void *user) {
  (void)module, (void)function, (void)text, (void)user;
}

static int set_up(newton *s) {
  if (SUNContext_Create(NULL, &s->context)) return 1;
  s->x = vector_create(s->size, s->context);
  s->scale = s->x ? N_VClone(s->x) : NULL;
  s->matrix = SUNDenseMatrix(s->size, s->size, s->context);
  if (!s->x || !s->scale || !s->matrix) return 1;
  N_VConst(1, s->scale);
  s->linear = SUNLinSol_Dense(s->x, s->matrix, s->context);
  s->kinsol = KINCreate(s->context);
  if (!s->linear || !s->kinsol) return 1;
  return KINSetErrHandlerFn(s->kinsol, quiet_error, NULL) ||
         KINSetInfoHandlerFn(s->kinsol, quiet_info, NULL) ||
         KINInit(s->kinsol, system_function, s->x) || KINSetUserData(s->kinsol, s) ||
         KINSetLinearSolver(s->kinsol, s->linear, s->matrix) ||
         KINSetJacFn(s->kinsol, jacobian_function) ||
         KINSetMaxSetupCalls(s->kinsol, JACOBIAN_LIFE) ||
         KINSetFuncNormTol(s->kinsol, SMALLEST_RESIDUAL) ||
         KINSetScaledStepTol(s->kinsol, SMALLEST_STEP) ||
         KINSetMaxNewtonStep(s->kinsol, LONGEST_STEP) || KINSetNumMaxIters(s->kinsol, ITERATIONS) ||
         vector_ran_out(s->x);
}

newton *newton_create(int size) {
  newton *s = calloc(1, sizeof *s);
  if (!s) return NULL;
  s->size = size;
  if (set_up(s)) {
    newton_free(s);
    return NULL;
  }
  return s;
}

void newton_free(newton *s) {
  if (!s) return;
  if (s->kinsol) KINFree(&s->kinsol);
  if (s->linear) SUNLinSolFree(s->linear);
  if (s->matrix) SUNMatDestroy(s->matrix);
  if (s->scale) N_VDestroy(s->scale);
  if (s->x) N_VDestroy(s->x);
  if (s->context) SUNContext_Free(&s->context);
  free(s);
}

static double largest(const double *f, int size) {
  double most = 0;
  for (int i = 0; i < size; i++)
    if (!(fabs(f[i]) <= most)) most = fabs(f[i]); // NaN stays
  return most;
}

bool newton_spent(const newton *s) {
  return s->solves >= MOST_SOLVES;
}

int newton_solve(newton *s, double *x, double *residual, newton_function *function,
                 const void *user) {
  if (newton_spent(s)) return 1;
  s->solves++;
  s->function = function;
  s->user = user;
  double f[NEWTON_MAX];
  if (function(f, NULL, x, user)) return 1;
  *residual = largest(f, s->size);
  if (!(*residual > SMALLEST_RESIDUAL)) return !isfinite(*residual);
  memcpy(NV_DATA_S(s->x), x, (size_t)s->size * sizeof x[0]);
  (void)KINSol(s->kinsol, s->x, KIN_NONE, s->scale, s->scale);
  // where it stopped, for whatever reason, counts if it is better
  if (function(f, NULL, NV_DATA_S(s->x), user)) return 1;
  double reached = largest(f, s->size);
  if (!isfinite(reached)) return 1;
  if (!(reached < *residual)) return 0;
  *residual = reached;
  memcpy(x, NV_DATA_S(s->x), (size_t)s->size * sizeof x[0]);
  return 0;
}
