// SPDX-License-Identifier: Apache-2.0
// Plots over time with dygraphs, linked through a group.

function cssColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}

function formatNumber(v) {
  if (v === null || v === undefined || Number.isNaN(v)) return '-';
  if (v === 0) return '0';
  const size = Math.abs(v);
  return size >= 1e-3 && size < 1e5 ? String(+v.toPrecision(5)) : v.toExponential(2);
}

function element(parent, tag, className, text) {
  const e = document.createElement(tag);
  if (className) e.className = className;
  if (text !== undefined) e.textContent = text;
  if (parent) parent.append(e);
  return e;
}

// Sizes below this say no more than zero does, and would only stretch the axis.
const SMALLEST_SHOWN = 1e-18;

// lines: [{name, color (of the style sheet), dash, values}]. A logarithmic plot shows sizes; zero
// has no place on it and leaves a gap.
function plotRows(time, lines, log) {
  const shown = (v) => {
    if (!log) return v;
    const size = Math.abs(v);
    return size >= SMALLEST_SHOWN ? size : null;
  };
  return Array.from(time, (t, k) => [t, ...lines.map((l) => shown(l.values[k]))]);
}

// Whole decades around what is shown.
function logRange(rows) {
  let low = Infinity, high = 0;
  for (const row of rows)
    for (const v of row.slice(1))
      if (v > 0) {
        low = Math.min(low, v);
        high = Math.max(high, v);
      }
  if (!(high > 0)) return [1e-18, 1];
  const down = Math.floor(Math.log10(low)), up = Math.ceil(Math.log10(high) + 0.1); // clear of the edge
  return [Math.pow(10, down), Math.pow(10, Math.max(up, down + 1))];
}

function decadeTicks(low, high) {
  const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
  const stride = Math.max(1, Math.ceil((last - first) / 5)), ticks = [];
  for (let e = first; e <= last; e += stride) ticks.push({v: Math.pow(10, e), label: '1e' + e});
  return ticks;
}

class Plot {
  // what: {title, log, lines}
  constructor(parent, group, what) {
    this.group = group;
    this.figure = element(parent, 'figure');
    this.caption = element(this.figure, 'figcaption');
    this.box = element(this.figure, 'div', 'plot');
    this.values = element(this.figure, 'div', 'values');
    this.show(what);
    group.listen((changed) => this.follow(changed));
  }

  show(what) {
    this.what = what;
    this.caption.textContent = what.title;
    if (this.graph) this.graph.destroy();
    const rows = plotRows(this.group.time, what.lines, what.log);
    this.rows = rows;
    const options = this.options(rows);
    this.graph = new Dygraph(this.box, rows, options);
    this.select();
  }

  options(rows) {
    const lines = this.what.lines, series = {};
    for (const l of lines)
      series[l.name] = {color: cssColor(l.color), strokePattern: l.dash || null, strokeWidth: l.width || 1.6};
    const axes = {
      x: {axisLabelFormatter: (t) => String(+t.toPrecision(6))},
      y: {axisLabelFormatter: (v) => formatNumber(v), axisLabelWidth: 58},
    };
    if (this.what.log) axes.y.ticker = (low, high) => decadeTicks(low, high);
    return {
      labels: ['time', ...lines.map((l) => l.name)], series, axes,
      logscale: Boolean(this.what.log),
      valueRange: this.what.log ? logRange(rows) : null,
      legend: 'never', dateWindow: this.group.window,
      axisLineColor: cssColor('dim'), gridLineColor: cssColor('line'), gridLineWidth: 0.5,
      animatedZooms: false, highlightCircleSize: 3,
      highlightCallback: (event, x) => this.group.setTime(x),
      unhighlightCallback: () => this.select(),
      pointClickCallback: null,
      clickCallback: (event, x) => {
        this.group.setTime(x);
        this.group.toggleMark(this.group.row);
      },
      zoomCallback: (begin, end) => this.zoomed(begin, end),
      drawCallback: (graph, first) => { if (!first) this.panned(graph); },
      underlayCallback: (context, area, graph) => this.drawCursors(context, area, graph),
    };
  }

  zoomed(begin, end) {
    const time = this.group.time, whole = begin <= time[0] && end >= time[time.length - 1];
    this.group.set('window', whole ? null : [begin, end]);
  }

  // Panning (shift and drag) tells no one but the plot itself.
  panned(graph) {
    const [begin, end] = graph.xAxisRange(), w = this.group.window;
    if (this.following || (w && Math.abs(w[0] - begin) + Math.abs(w[1] - end) < 1e-9)) return;
    if (w) this.zoomed(begin, end);
  }

  // What lies beyond the horizon of an unstable ride is not judged: shaded.
  shadeHorizon(context, area, graph) {
    const {horizon, time} = this.group;
    if (horizon === null || !(horizon < time[time.length - 1])) return;
    const x = Math.max(area.x, graph.toDomXCoord(horizon));
    context.fillStyle = cssColor('ground');
    if (x < area.x + area.w) context.fillRect(x, area.y, area.x + area.w - x, area.h);
  }

  drawCursors(context, area, graph) {
    this.shadeHorizon(context, area, graph);
    for (const [row, name] of [[this.group.mark, 'A'], [this.group.row, '']]) {
      if (row < 0) continue;
      const x = Math.round(graph.toDomXCoord(this.group.time[row])) + 0.5;
      if (x < area.x || x > area.x + area.w) continue;
      context.strokeStyle = cssColor(name ? 'fourth' : 'ink');
      context.lineWidth = 1;
      context.beginPath();
      context.moveTo(x, area.y);
      context.lineTo(x, area.y + area.h);
      context.stroke();
      context.fillStyle = context.strokeStyle;
      context.fillText(name, x + 3, area.y + 10);
    }
  }

  follow(changed) {
    this.following = true;
    if (changed === 'window')
      this.graph.updateOptions({dateWindow: this.group.window, valueRange: this.what.log ? logRange(this.rows) : null});
    else
      this.redraw();
    this.following = false;
    this.select();
  }

  // The cursors lie under the lines, so they are drawn anew: once a frame, however often they move.
  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.following = true;
      this.graph.updateOptions({});
      this.following = false;
    });
  }

  select() {
    const {row, mark} = this.group;
    this.values.replaceChildren();
    for (const l of this.what.lines) {
      const span = element(this.values, 'span');
      const name = element(span, 'b', '', l.name);
      name.style.color = cssColor(l.color);
      let text = ' ' + formatNumber(l.values[row]);
      if (mark >= 0) text += ' (B-A ' + formatNumber(l.values[row] - l.values[mark]) + ')';
      span.append(text);
    }
  }
}
