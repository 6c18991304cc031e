// SPDX-License-Identifier: Apache-2.0
// Vectors and symmetric tensors of the kernel. `real` is the including file's number type: double,
// double complex, or a GCC vector of doubles; hence no comparison, branch or scalar initialiser.
#ifndef BICYCLE_KERNEL_VECTOR_H
#define BICYCLE_KERNEL_VECTOR_H

typedef struct vec {
  real x, y, z;
} vec;

static inline vec vec_of(const real a[3]) {
  return (vec){a[0], a[1], a[2]};
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

// J = (xx, yy, zz, xy, xz, yz)
static inline vec times(const real J[6], vec a) {
  return (vec){J[0] * a.x + J[3] * a.y + J[4] * a.z, J[3] * a.x + J[1] * a.y + J[5] * a.z,
               J[4] * a.x + J[5] * a.y + J[2] * a.z};
}

// Acceleration of a point fixed at r in a frame with angular velocity w and acceleration al.
static inline vec carried(vec al, vec w, vec r) {
  return add(cross(al, r), cross(w, cross(w, r)));
}

// Components in axes turned by +phi about z: R_z(-phi) a.
static inline vec into_turned(real s, real c, vec a) {
  return (vec){c * a.x + s * a.y, c * a.y - s * a.x, a.z};
}

// Components back in the unturned axes: R_z(phi) a.
static inline vec out_of_turned(real s, real c, vec a) {
  return (vec){c * a.x - s * a.y, c * a.y + s * a.x, a.z};
}

#endif
