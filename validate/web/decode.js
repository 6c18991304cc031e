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

// A scenario's traces: {rows, step, stride, time, geometry, units, column(side, name)}.
async function decodeScenario(element) {
  const packed = JSON.parse(element.textContent);
  const bytes = await inflate(packed.bytes), rows = packed.rows;
  const columns = new Map(), units = new Map();
  let at = 0;
  for (const c of packed.columns) {
    const linear = c.coding === 'linear';
    columns.set(c.side + '.' + c.name, (linear ? decodeLinear : decodeLog)(bytes, at, rows, c));
    units.set(c.name, c.unit);
    at += (linear ? 3 : 2) * rows;
  }
  if (at !== bytes.length) throw new Error('damaged traces');
  addForces(columns, units, rows, packed.geometry);
  const time = Float64Array.from({length: rows}, (_, k) => k * packed.step);
  return {
    rows, time, units, stride: packed.stride, step: packed.step, geometry: packed.geometry,
    column: (side, name) => columns.get(side + '.' + name),
    candidate(name) {
      const a = columns.get('reference.' + name), d = columns.get('residual.' + name);
      return a.map((v, k) => v + d[k]);
    },
  };
}

// Friction demand, horizontal over normal force, follows from the forces of both engines.
function addForces(columns, units, rows) {
  for (const wheel of ['rear', 'front']) {
    const force = ['forward', 'left', 'up'].map((d) => wheel + '_force_' + d);
    const a = force.map((n) => columns.get('reference.' + n));
    const d = force.map((n) => columns.get('residual.' + n));
    const demand = (k, share) => {
      const f = a.map((v, i) => v[k] + share * d[i][k]);
      return Math.hypot(f[0], f[1]) / f[2];
    };
    const name = wheel + '_friction';
    columns.set('reference.' + name, Float64Array.from({length: rows}, (_, k) => demand(k, 0)));
    columns.set('residual.' + name,
      Float64Array.from({length: rows}, (_, k) => demand(k, 1) - demand(k, 0)));
    units.set(name, '');
  }
}
