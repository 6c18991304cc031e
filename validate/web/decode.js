// SPDX-License-Identifier: Apache-2.0
// Reads back what report_pack.c wrote; its header tells the format.
'use strict';

function bytesOfBase64(text) {
  return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
}

async function inflate(text) {
  const stream = new Blob([bytesOfBase64(text)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const LINEAR_NONE = 0xffffff;
const LOG_NONE = 0x7fff;

function decodeLinear(bytes, at, rows, column) {
  const values = new Float64Array(rows);
  let code = 0, slope = 0;
  for (let k = 0; k < rows; k++) {
    const zigzag = bytes[at + k] | bytes[at + rows + k] << 8 | bytes[at + 2 * rows + k] << 16;
    const bend = (zigzag >>> 1) ^ (zigzag & 1 ? LINEAR_NONE : 0);
    slope = (slope + bend) & LINEAR_NONE;
    code = (code + slope) & LINEAR_NONE;
    values[k] = code === LINEAR_NONE ? NaN : column.low + code * column.scale;
  }
  return values;
}

function decodeLog(bytes, at, rows, column) {
  const values = new Float64Array(rows);
  for (let k = 0; k < rows; k++) {
    const word = bytes[at + k] | bytes[at + rows + k] << 8, code = word & 0x7fff;
    const size = Math.pow(10, column.low + (code - 1) * column.scale);
    values[k] = code === LOG_NONE ? NaN : code === 0 ? 0 : word & 0x8000 ? -size : size;
  }
  return values;
}

// A scenario's traces: {rows, step, stride, time, geometry, units, column(side, name),
// candidate(name), either(name)}. A signal of a side is NaN where that side does not know it.
async function decodeScenario(element) {
  const packed = JSON.parse(element.textContent);
  const bytes = await inflate(packed.bytes), rows = packed.rows;
  const columns = new Map(), units = new Map();
  let at = 0;
  for (const c of packed.columns) {
    const linear = c.coding === 'linear';
    const values = (linear ? decodeLinear : decodeLog)(bytes, at, rows, c);
    columns.set(c.side + '.' + c.name, values);
    if (c.ends) columns.set('reference.' + c.name, values.map((v, k) => k < c.ends[0] ? v : NaN));
    units.set(c.name, c.unit);
    at += (linear ? 3 : 2) * rows;
  }
  if (at !== bytes.length) throw new Error('damaged traces');
  for (const c of packed.columns)
    if (c.ends) columns.set('candidate.' + c.name, candidateOf(c.name, c.ends, columns));
  addFriction(columns, units);
  const time = Float64Array.from({length: rows}, (_, k) => k * packed.step);
  return {
    rows, time, units, stride: packed.stride, step: packed.step, geometry: packed.geometry,
    column: (side, name) => columns.get(side + '.' + name),
    candidate: (name) => columns.get('candidate.' + name),
    either: (name) => columns.get('signal.' + name),
  };
}

// Where the reference has ended the signal is the candidate's.
function candidateOf(name, ends, columns) {
  const signal = columns.get('signal.' + name), residual = columns.get('residual.' + name);
  return signal.map((v, k) => k >= ends[1] ? NaN : k >= ends[0] ? v : v + residual[k]);
}

// Friction demand, horizontal over normal force, follows from the forces of both engines.
function addFriction(columns, units) {
  for (const wheel of ['rear', 'front']) {
    const demand = (side) => {
      const [f, l, u] = ['forward', 'left', 'up'].map((d) => columns.get(side + '.' + wheel + '_force_' + d));
      return u.map((v, k) => Math.hypot(f[k], l[k]) / v);
    };
    const name = wheel + '_friction', reference = demand('reference'), candidate = demand('candidate');
    columns.set('reference.' + name, reference);
    columns.set('candidate.' + name, candidate);
    columns.set('residual.' + name, candidate.map((v, k) => v - reference[k]));
    units.set(name, '');
  }
}
