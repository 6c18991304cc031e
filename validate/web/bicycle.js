// SPDX-License-Identifier: Apache-2.0
// Where the points of a bicycle are. Axes: x forward, y left, z up; vectors are arrays of three.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (s, a) => [s * a[0], s * a[1], s * a[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => times(1 / Math.hypot(...a), a);

// Rodrigues: v turned about the unit axis by an angle.
function turn(axis, angle, v) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(times(c, v), times(s, cross(axis, v))), times((1 - c) * dot(axis, v), axis));
}

// Columns of the traces that place a bicycle.
const PLACE = ['x', 'y', 'yaw', 'lean', 'pitch', 'steer', 'rear_angle', 'front_angle'];

// A circle about `hub` in the plane of forward and up, with spokes that turn by `angle` forward.
function wheelPoints(hub, radius, forward, up, angle) {
  const at = (theta, r) => add(hub, add(times(r * Math.sin(theta), forward), times(r * Math.cos(theta), up)));
  const rim = Array.from({length: 49}, (_, i) => at(i * Math.PI / 24, radius));
  const spokes = Array.from({length: 5}, (_, i) => [hub, at(angle + i * Math.PI * 0.4, radius)]);
  return {rim, spokes};
}

// All points of a bicycle of geometry g; s holds the values of PLACE.
function poseBicycle(g, s) {
  const upright = (v) => turn([0, 0, 1], s.yaw, turn([1, 0, 0], s.lean, v)); // wheel plane
  const body = (v) => upright(turn([0, 1, 0], s.pitch, v)); // rear frame
  const contact = [s.x, s.y, 0];
  const hub = add(contact, upright([0, 0, g.rear_radius]));
  const frame = (p) => add(hub, body(sub(p, g.rear_hub)));
  // The steering axis leans back by the tilt and meets the ground `trail` before the front contact.
  const axis = [-Math.sin(g.tilt), 0, Math.cos(g.tilt)];
  const foot = [g.wheelbase + g.trail, 0, 0];
  const fork = (p) => frame(add(foot, turn(axis, s.steer, sub(p, foot))));
  const forkDirection = (v) => body(turn(axis, s.steer, v));
  const frontHub = fork(g.front_hub);
  const axle = forkDirection([0, 1, 0]);
  // The lowest point of the front wheel: straight down within its plane.
  const down = unit(sub(times(dot([0, 0, 1], axle), axle), [0, 0, 1]));
  const onAxis = (height) => add(foot, times(height / Math.cos(g.tilt), axis));
  const crown = onAxis(2.15 * g.front_radius), bar = onAxis(2.15 * g.front_radius + 0.3);
  const seat = [g.weight[0], 0, Math.max(0.75 * g.weight[2], 1.6 * g.rear_radius)];
  const pedals = [0.45 * g.wheelbase, 0, 0.85 * Math.min(g.rear_radius, g.front_radius)];
  const forkEnd = (side) => fork(add(bar, [0, side * 0.28, 0]));
  return {
    contact, hub, frontHub, frontContact: add(frontHub, times(g.front_radius, down)),
    weight: frame(g.weight),
    rear: wheelPoints(hub, g.rear_radius, body([1, 0, 0]), body([0, 0, 1]), s.rear_angle),
    front: wheelPoints(frontHub, g.front_radius, forkDirection([1, 0, 0]), forkDirection([0, 0, 1]), s.front_angle),
    tubes: [
      [hub, frame(pedals), frame(crown)], [hub, frame(seat), frame(pedals)], [frame(seat), frame(bar)],
      [frame(seat), frame(g.weight)],
    ],
    fork: [[frontHub, fork(crown), fork(bar)], [forkEnd(-1), fork(bar), forkEnd(1)]],
  };
}
