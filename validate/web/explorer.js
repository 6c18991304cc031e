// SPDX-License-Identifier: Apache-2.0
// One scenario, explored: two signals of both engines, their difference, energy, constraints, and
// the replay, all at one time.

const SIGNALS = [
  'lean', 'steer', 'lean_rate', 'steer_rate', 'speed', 'yaw', 'x', 'y', 'pitch', 'rear_angle', 'front_angle',
  'energy', 'rear_force_up', 'front_force_up', 'rear_force_left', 'front_force_left', 'rear_force_forward',
  'front_force_forward', 'rear_friction', 'front_friction',
];
const EPSILON = Math.pow(2, -52); // of double

class Explorer {
  constructor(section, data, facts) {
    Object.assign(this, {section, data, facts, chosen: ['lean', 'steer']});
    this.labels = facts.engines.map((e) => e.label);
    this.group = new Group(data.time);
    this.group.horizon = facts.horizon ? facts.horizon.time : null; // s, up to where it can be predicted
    this.live = section.querySelector('.live');
    this.live.hidden = false;
    this.plots = [];
    this.makeBar();
    this.makeStage();
    this.makePlots();
    this.group.listen(() => this.showTime());
    this.group.setTime(this.closestTime());
    this.showTime();
  }

  // When the ride comes closest to a limit: worth looking at first.
  closestTime() {
    let worst = -1, time = 0;
    for (const g of this.facts.gates)
      if (g.time !== undefined && g.limit > 0 && g.value / g.limit > worst) {
        worst = g.value / g.limit;
        time = g.time;
      }
    return time;
  }

  makeBar() {
    const bar = element(this.live, 'div', 'bar');
    this.play = element(bar, 'button', '', 'Play');
    this.play.addEventListener('click', () => this.togglePlay());
    const label = element(bar, 'label', 'time');
    this.slider = element(label, 'input');
    Object.assign(this.slider, {type: 'range', min: 0, max: this.data.rows - 1, step: 1, value: 0});
    this.slider.setAttribute('aria-label', 'time');
    this.slider.addEventListener('input', () => this.group.set('row', Number(this.slider.value)));
    this.clock = element(label, 'output');
    this.rate = this.choice(bar, 'Speed', ['1', '0.25', '0.05', '4'], '1');
    element(bar, 'button', '', 'Whole ride').addEventListener('click', () => this.group.set('window', null));
    element(bar, 'button', '', 'CSV').addEventListener('click', () =>
      save(this.section.id + '.csv', 'text/csv', csvText(this.data, this.labels, SIGNALS)));
    this.readout = element(this.live, 'div', 'readout dim');
  }

  choice(parent, name, values, chosen) {
    const label = element(parent, 'label', '', name);
    const select = element(label, 'select');
    for (const v of values) element(select, 'option', '', v).value = v;
    select.value = chosen;
    return select;
  }

  makeStage() {
    const figure = element(this.live, 'figure', 'stage');
    const canvas = element(figure, 'canvas');
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', 'both bicycles at the time of the cursor');
    element(figure, 'p', '', 'Drag to turn, shift and wheel to zoom. Squares: 1 m. Arrows: forces of the ground.');
    if (!this.data.geometry) {
      figure.hidden = true;
      return;
    }
    this.replay = new Replay(canvas, this.group, this.data);
    this.makeMagnifier(this.live.querySelector('.bar'));
  }

  makeMagnifier(bar) {
    const label = element(bar, 'label', '', 'Magnify differences');
    const slider = element(label, 'input', 'magnify'), shown = element(label, 'output');
    const best = this.replay.fittingDecades();
    Object.assign(slider, {type: 'range', min: 0, max: best + 1, step: 0.5, value: best});
    const apply = () => {
      const factor = Math.pow(10, Number(slider.value));
      shown.textContent = factor === 1 ? 'x1 (as it is)' : 'x' + factor.toExponential(0);
      this.replay.setMagnify(factor);
    };
    slider.addEventListener('input', apply);
    apply();
  }

  makePlots() {
    const pair = element(this.live, 'div', 'pair');
    this.chosen.forEach((name, i) => this.makeSignal(pair, i));
    this.chosen.forEach((name, i) =>
      this.plots.push(this[i ? 'second' : 'first'] = new Plot(this.live, this.group, this.residualPlot(this.chosen[i]))));
    this.plots.push(new Plot(this.live, this.group, this.energyPlot()));
    const contacts = this.contactPlot();
    if (contacts.lines.length) this.plots.push(new Plot(this.live, this.group, contacts));
  }

  makeSignal(parent, index) {
    const plot = new Plot(parent, this.group, this.signalPlot(this.chosen[index]));
    const select = this.choice(null, '', SIGNALS, this.chosen[index]);
    select.setAttribute('aria-label', 'signal');
    plot.caption.replaceChildren(select);
    select.addEventListener('change', () => {
      this.chosen[index] = select.value;
      plot.show(this.signalPlot(select.value));
      plot.caption.replaceChildren(select);
      this[index ? 'second' : 'first'].show(this.residualPlot(select.value));
    });
    this.plots.push(plot);
  }

  signalPlot(name) {
    return {
      title: name,
      lines: [
        {name: this.labels[0], color: 'ref', width: 3, values: this.data.column('reference', name)},
        {name: this.labels[1], color: 'cand', dash: [6, 4], values: this.data.candidate(name)},
      ],
    };
  }

  gates(signal, metric) {
    return this.facts.gates.filter((g) => g.signal === signal && g.metric === metric);
  }

  // A limit as a line, where something is judged; that of an unstable ride grows with it.
  limitLine(signal, metric) {
    const gates = [...this.gates(signal, metric), ...this.gates(signal, 'scaled_max')];
    if (!gates.length) return [];
    const rate = this.facts.setup.growth_rate;
    const values = this.data.time.map((t) => {
      const here = gates.filter((g) => t >= (g.from ?? 0) && t <= (g.to ?? Infinity));
      const limits = here.map((g) => g.metric === 'scaled_max' ? g.limit * Math.exp(rate * t) : g.limit);
      return limits.length ? Math.min(...limits) : NaN;
    });
    return [{name: 'limit', color: 'bad', dash: [8, 3], width: 1, values}];
  }

  floorLine(size) {
    return size > 0 ? [{name: 'rounding', color: 'dim', dash: [2, 3], width: 1, values: this.data.time.map(() => size)}] : [];
  }

  residualPlot(name) {
    const largest = this.data.column('reference', name).reduce((m, v) => Math.max(m, Math.abs(v) || 0), 0);
    const unit = this.data.units.get(name), values = this.data.column('residual', name);
    const silent = values.some((v) => v === 0) && values.every((v) => v === 0 || Number.isNaN(v));
    return {
      title: 'Difference in ' + name + (unit ? ', ' + unit : '') + (silent ? ': exactly zero throughout' : ''),
      log: true,
      lines: [{name: 'difference', color: 'diff', values}, ...this.limitLine(name, 'max'),
        ...this.floorLine(EPSILON * largest)],
    };
  }

  energyPlot() {
    const lines = this.labels.map((label, i) => ({
      name: label, color: i ? 'cand' : 'ref', values: this.data.column(label, 'balance'),
    }));
    const [gate] = this.gates(this.labels[1] + '.energy', 'balance_max');
    if (gate) lines.push({name: 'limit', color: 'bad', dash: [8, 3], width: 1, values: this.data.time.map(() => gate.limit)});
    return {title: 'Energy not accounted for, of the energy at the start', log: true, lines: [...lines, ...this.floorLine(EPSILON)]};
  }

  contactPlot() {
    const lines = [];
    for (const label of this.labels)
      [['rear_slip', 'ref'], ['front_slip', 'cand'], ['rear_height', 'third'], ['front_height', 'fourth']].forEach(([name, color]) => {
        const values = this.data.column(label, name);
        if (values) lines.push({name: label + ' ' + name, color, values});
      });
    return {title: 'Violated constraints: slip, m/s; height, m', log: true, lines};
  }

  showTime() {
    const {row, mark, time} = this.group;
    this.slider.value = row;
    this.clock.textContent = time[row].toFixed(2) + ' s';
    const thinned = this.data.stride > 1 ? ' Every ' + this.data.stride + 'th row is shown; differences are the largest in between.' : '';
    this.readout.textContent = mark < 0
      ? 'Drag over a plot to zoom, double-click for all, click to set cursor A.' + thinned
      : 'A ' + time[mark].toFixed(3) + ' s, B ' + time[row].toFixed(3) + ' s, B-A ' + (time[row] - time[mark]).toFixed(3) + ' s';
  }

  togglePlay() {
    this.playing = !this.playing;
    this.play.textContent = this.playing ? 'Pause' : 'Play';
    if (!this.playing) return;
    const {time} = this.group, end = time[time.length - 1];
    let at = this.group.row === time.length - 1 ? 0 : time[this.group.row], last = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      at = Math.min(end, at + Number(this.rate.value) * (now - last) / 1000);
      last = now;
      this.group.setTime(at);
      if (at < end) requestAnimationFrame(tick);
      else this.togglePlay();
    };
    requestAnimationFrame(tick);
  }

  // Colours have changed.
  restyle() {
    const {plots} = this;
    plots.forEach((p) => {
      const select = p.caption.querySelector('select');
      p.show(p.what);
      if (select) p.caption.replaceChildren(select);
    });
    if (this.replay) this.replay.request();
  }
}
