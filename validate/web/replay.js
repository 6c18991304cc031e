// SPDX-License-Identifier: Apache-2.0
// Both bicycles in space at the time of the cursor, the candidate with its differences magnified.

class Replay {
  constructor(canvas, group, data) {
    Object.assign(this, {canvas, group, data, azimuth: -0.9, elevation: 0.32, zoom: 1, magnify: 1});
    // Of the candidate where the reference has ended: there is always something to look at.
    this.reference = PLACE.map((n) => this.known(n, data.either(n)));
    this.residual = PLACE.map((n) => this.known(n, data.column('residual', n)));
    this.has = ['reference', 'candidate'].map((side) => Array.from(data.column(side, 'x'), Number.isFinite));
    this.force = {};
    for (const wheel of ['rear', 'front'])
      this.force[wheel] = ['forward', 'left', 'up'].map((d) => data.either(wheel + '_force_' + d));
    this.retrack();
    group.listen((changed) => { if (changed === 'row') this.request(); });
    this.listen();
    new ResizeObserver(() => this.request()).observe(canvas);
  }

  // A wheel alone has no pitch and no front wheel; nothing of a bicycle is drawn then.
  known(name, values) {
    const absent = this.data.geometry.wheel_only && (name === 'pitch' || name === 'front_angle');
    return absent ? new Float64Array(values.length) : values;
  }

  // The values of PLACE at a row; `share` 0: of the reference, 1: of the candidate.
  place(row, share) {
    const s = {}, both = share && this.has[0][row];
    PLACE.forEach((name, i) => { s[name] = this.reference[i][row] + (both ? share * this.residual[i][row] : 0); });
    return s;
  }

  pose(row, share) {
    return poseBicycle(this.data.geometry, this.place(row, share));
  }

  // Tracks on the ground of both wheels of both bicycles.
  retrack() {
    this.tracks = [0, this.magnify].map((share) => {
      const poses = Array.from({length: this.data.rows}, (_, k) => this.pose(k, share));
      return {rear: poses.map((p) => p.contact), front: poses.map((p) => p.frontContact)};
    });
  }

  setMagnify(factor) {
    this.magnify = factor;
    this.retrack();
    this.request();
  }

  // The largest power of ten that keeps magnified angles below 0.1 rad and places below 0.2 m.
  fittingDecades() {
    let worst = 0;
    PLACE.forEach((name, i) => {
      if (name.endsWith('angle')) return;
      const scale = name === 'x' || name === 'y' ? 0.2 : 0.1;
      for (const d of this.residual[i]) if (Math.abs(d) / scale > worst) worst = Math.abs(d) / scale;
    });
    return worst > 0 ? Math.max(0, Math.floor(-Math.log10(worst))) : 0;
  }

  listen() {
    let last = null;
    this.canvas.addEventListener('pointerdown', (e) => {
      last = e;
      this.canvas.setPointerCapture(e.pointerId);
    });
    this.canvas.addEventListener('pointermove', (e) => {
      if (!last) return;
      this.azimuth -= (e.clientX - last.clientX) * 0.01;
      this.elevation = Math.max(0.02, Math.min(1.5, this.elevation + (e.clientY - last.clientY) * 0.01));
      last = e;
      this.request();
    });
    for (const end of ['pointerup', 'pointercancel']) this.canvas.addEventListener(end, () => { last = null; });
    this.canvas.addEventListener('dblclick', () => {
      Object.assign(this, {azimuth: -0.9, elevation: 0.32, zoom: 1});
      this.request();
    });
    this.canvas.addEventListener('wheel', (e) => {
      if (!e.ctrlKey && !e.shiftKey) return; // the page scrolls
      e.preventDefault();
      this.zoom = Math.max(0.2, Math.min(8, this.zoom * Math.exp(-0.002 * (e.deltaY || e.deltaX))));
      this.request();
    }, {passive: false});
  }

  request() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  // A camera that looks at `target` from behind the bicycle's heading plus the chosen angle.
  aim(target, yaw, width, height) {
    const a = yaw + this.azimuth + Math.PI, e = this.elevation;
    const back = [Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)];
    const right = unit(cross([0, 0, 1], back)), up = cross(back, right);
    const g = this.data.geometry;
    const size = g.wheel_only ? 3.2 * g.rear_radius : Math.max(1.8, g.weight[2] + 0.6);
    const distance = 6, focus = this.zoom * distance * Math.min(width / (1.5 * size), height / (1.25 * size));
    this.project = (p) => {
      const d = sub(p, target), depth = distance - dot(d, back);
      if (!(depth > 0.5)) return null;
      return [width / 2 + focus * dot(d, right) / depth, height * 0.52 - focus * dot(d, up) / depth, focus / depth];
    };
  }

  line(points, color, width, dash) {
    const c = this.context;
    c.strokeStyle = color;
    c.lineWidth = width;
    c.setLineDash(dash || []);
    c.beginPath();
    let joined = false;
    for (const p of points) {
      const q = this.project(p);
      if (!q) joined = false;
      else if (joined) c.lineTo(q[0], q[1]);
      else c.moveTo(q[0], q[1]);
      joined = Boolean(q);
    }
    c.stroke();
    c.setLineDash([]);
  }

  dot(p, radius, color) {
    const q = this.project(p);
    if (!q) return;
    this.context.fillStyle = color;
    this.context.beginPath();
    this.context.arc(q[0], q[1], Math.max(2, radius * q[2]), 0, 7);
    this.context.fill();
  }

  drawGround(centre) {
    const x0 = Math.round(centre[0]), y0 = Math.round(centre[1]), color = cssColor('ground'), n = 6;
    for (let i = -n; i <= n; i++) {
      this.line([[x0 - n, y0 + i, 0], [x0 + n, y0 + i, 0]], color, 1);
      this.line([[x0 + i, y0 - n, 0], [x0 + i, y0 + n, 0]], color, 1);
    }
  }

  // The part of the tracks some metres around the bicycle.
  drawTracks(row) {
    const reach = Math.ceil(6 / Math.max(0.5, this.speed() * this.data.step));
    const from = Math.max(0, row - reach), to = Math.min(this.data.rows, row + reach);
    this.tracks.forEach((track, i) => {
      const color = cssColor(i ? 'cand' : 'ref'), part = (points) => points.slice(from, to).filter((_, k) => this.has[i][from + k]);
      this.line(part(track.rear), color, 1.5, i ? [5, 4] : []);
      if (!this.data.geometry.wheel_only) this.line(part(track.front), color, 1, i ? [5, 4] : [2, 3]);
    });
  }

  speed() {
    const v = this.data.either('speed');
    return Math.abs(v[this.group.row]) || 1;
  }

  drawBicycle(pose, color, width, dash) {
    const alone = this.data.geometry.wheel_only;
    for (const wheel of alone ? [pose.rear] : [pose.rear, pose.front]) {
      this.line(wheel.rim, color, width, dash);
      for (const spoke of wheel.spokes) this.line(spoke, color, 0.6);
    }
    this.dot(pose.contact, 0.02, color);
    if (alone) return;
    for (const tube of [...pose.tubes, ...pose.fork]) this.line(tube, color, width, dash);
    this.dot(pose.weight, 0.09, color);
    this.dot(pose.frontContact, 0.02, color);
  }

  // Force of the ground on each wheel: half a metre for half the weight.
  drawForces(pose, row, yaw) {
    const c = Math.cos(yaw), s = Math.sin(yaw), g = this.data.geometry;
    const unit = (g.wheel_only ? 2 * g.rear_radius : 1) / g.total_weight; // m/N
    for (const [wheel, at] of [['rear', pose.contact], ['front', pose.frontContact]]) {
      const [f, l, u] = this.force[wheel].map((v) => v[row] * unit);
      if (!Number.isFinite(f + l + u)) continue;
      const tip = add(at, [c * f - s * l, s * f + c * l, u]);
      this.line([at, tip], cssColor('third'), 2.5);
      this.dot(tip, 0.025, cssColor('third'));
    }
  }

  draw() {
    const ratio = window.devicePixelRatio || 1, width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0) return;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    this.context = this.canvas.getContext('2d');
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, width, height);
    const row = this.group.row, place = this.place(row, 0), pose = this.pose(row, 0), g = this.data.geometry;
    if (!Number.isFinite(place.x + place.pitch)) return;
    const centre = g.wheel_only ? pose.contact : times(0.5, add(pose.contact, pose.frontContact));
    const eye = g.wheel_only ? g.rear_radius : 0.45 * g.weight[2] + 0.1;
    this.aim(add(centre, [0, 0, eye]), place.yaw, width, height);
    this.drawGround(centre);
    this.drawTracks(row);
    this.drawForces(pose, row, place.yaw);
    if (this.has[0][row]) this.drawBicycle(pose, cssColor('ref'), 2.6);
    if (this.has[1][row]) this.drawBicycle(this.pose(row, this.magnify), cssColor('cand'), 1.8, [6, 3]);
    this.drawn = row;
  }
}
