// SPDX-License-Identifier: Apache-2.0
// Vectors and symmetric tensors of the kernel. `real` is the including file's number type: double,
// double complex, or a GCC vector of doubles; hence no comparison, branch or scalar initialiser.
#ifndef BICYCLE_KERNEL_VECTOR_H
#define BICYCLE_KERNEL_VECTOR_H

typedef struct vec {
  real x, y, z;
} vec;

// Symmetric tensor.
typedef struct tensor {
  real xx, yy, zz, xy, xz, yz;
} tensor;

static inline vec vec_of(const real a[3]) {
  return (vec){a[0], a[1], a[2]};
}

static inline tensor tensor_of(const real J[6]) {
  return (tensor){J[0], J[1], J[2], J[3], J[4], J[5]};
}

static inline vec add(vec a, vec b) {
  return (vec){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline vec scaled(real s, vec a) {
  return (vec){s * a.x, s * a.y, s * a.z};
}

static inline real dot(vec a, vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec cross(vec a, vec b) {
  return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline vec times(const tensor *J, vec a) {
  return (vec){J->xx * a.x + J->xy * a.y + J->xz * a.z, J->xy * a.x + J->yy * a.y + J->yz * a.z,
               J->xz * a.x + J->yz * a.y + J->zz * a.z};
}

// Acceleration of a point fixed at r in a frame with angular velocity w and acceleration al.
static inline vec carried(vec al, vec w, vec r) {
  return add(cross(al, r), cross(w, cross(w, r)));
}

// Components after a turn of the vector by an angle about x, or z.
static inline vec turned_about_x(vec a, real s, real c) {
  return (vec){a.x, c * a.y - s * a.z, s * a.y + c * a.z};
}

static inline vec turned_about_z(vec a, real s, real c) {
  return (vec){c * a.x - s * a.y, s * a.x + c * a.y, a.z};
}

// The same for a tensor: with axis 3 as the axis of the turn,
//   11' = 11 - d, 22' = 22 + d, 12' = sc (11 - 22) + (c^2 - s^2) 12,  d = s^2 (11 - 22) + 2 sc 12
static inline tensor tensor_about_x(tensor J, real s, real c) {
  real sc = s * c, ss = s * s, gap = J.yy - J.zz;
  real d = ss * gap + 2.0 * sc * J.yz;
  return (tensor){J.xx,
                  J.yy - d,
                  J.zz + d,
                  c * J.xy - s * J.xz,
                  s * J.xy + c * J.xz,
                  sc * gap + (c * c - ss) * J.yz};
}

static inline tensor tensor_about_z(tensor J, real s, real c) {
  real sc = s * c, ss = s * s, gap = J.xx - J.yy;
  real d = ss * gap + 2.0 * sc * J.xy;
  return (tensor){
      J.xx - d,           J.yy + d, J.zz, sc * gap + (c * c - ss) * J.xy, c * J.xz - s * J.yz,
      s * J.xz + c * J.yz};
}

// Adds a body with first moment d and tensor J about a point p to a tensor about the origin:
//   J + (2 p.d + m p^2) 1 - p d^T - d p^T - m p p^T
static inline void add_shifted(tensor *sum, tensor J, real mass, vec d, vec p) {
  vec h = add(d, scaled(0.5 * mass, p)); // p h^T + h p^T holds both products
  real x = 2.0 * p.x * h.x, y = 2.0 * p.y * h.y, z = 2.0 * p.z * h.z;
  sum->xx += J.xx + y + z;
  sum->yy += J.yy + x + z;
  sum->zz += J.zz + x + y;
  sum->xy += J.xy - (p.x * h.y + p.y * h.x);
  sum->xz += J.xz - (p.x * h.z + p.z * h.x);
  sum->yz += J.yz - (p.y * h.z + p.z * h.y);
}

#endif
