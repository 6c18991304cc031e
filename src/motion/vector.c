// SPDX-License-Identifier: Apache-2.0
#include "motion/vector.h"

#include <stdlib.h>

typedef struct family {
  N_Vector reserve;
  int members; // without the reserve
  bool ran_out;
} family;

// NV_CONTENT_S reads its beginning.
typedef struct content {
  struct _N_VectorContent_Serial serial;
  family *family;
  realtype data[];
} content;

static family *family_of(N_Vector v) {
  return ((content *)v->content)->family;
}

static N_Vector make(family *f, N_Vector like, sunindextype length) {
  N_Vector v = N_VNewEmpty(like->sunctx);
  content *c = v ? calloc(1, sizeof *c + (size_t)length * sizeof c->data[0]) : NULL;
  if (!c || N_VCopyOps(like, v)) {
    free(c);
    if (v) N_VFreeEmpty(v);
    return NULL;
  }
  c->serial.length = length;
  c->serial.data = c->data;
  c->family = f;
  v->content = c;
  return v;
}

static void release(N_Vector v) {
  free(v->content);
  v->content = NULL;
  N_VFreeEmpty(v);
}

static N_Vector clone(N_Vector like) {
  family *f = family_of(like);
  N_Vector v = make(f, like, NV_LENGTH_S(like));
  if (v)
    f->members++;
  else
    f->ran_out = true;
  return v ? v : f->reserve;
}

static void destroy(N_Vector v) {
  family *f = family_of(v);
  if (v == f->reserve) return;
  release(v);
  if (--f->members > 0) return;
  release(f->reserve);
  free(f);
}

N_Vector vector_create(sunindextype length, SUNContext context) {
  family *f = calloc(1, sizeof *f);
  N_Vector plain = N_VNewEmpty_Serial(length, context);
  if (f && plain) {
    plain->ops->nvclone = clone;
    plain->ops->nvcloneempty = NULL; // would make vectors without a family
    plain->ops->nvdestroy = destroy;
    f->reserve = make(f, plain, length);
  }
  N_Vector first = f && f->reserve ? make(f, plain, length) : NULL;
  if (plain) N_VDestroy_Serial(plain);
  if (first) {
    f->members = 1;
    return first;
  }
  if (f && f->reserve) release(f->reserve);
  free(f);
  return NULL;
}

bool vector_ran_out(N_Vector any) {
  return family_of(any)->ran_out;
}
