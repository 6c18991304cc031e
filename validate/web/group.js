// SPDX-License-Identifier: Apache-2.0
// What plots and replay share: one cursor, one window of time, one mark to measure from.

class Group {
  constructor(time) {
    this.time = time;
    this.row = 0;
    this.mark = -1; // row of cursor A, or -1
    this.window = null; // [begin, end] in s; null: the whole ride
    this.listeners = [];
  }

  // listener(what): "row", "mark" or "window" has changed.
  listen(listener) {
    this.listeners.push(listener);
  }

  set(what, value) {
    if (this[what] === value) return;
    this[what] = value;
    for (const listener of this.listeners) listener(what);
  }

  setTime(seconds) {
    const step = this.time.length > 1 ? this.time[1] - this.time[0] : 1;
    const row = Math.round(seconds / step);
    this.set('row', Math.max(0, Math.min(this.time.length - 1, row)));
  }

  toggleMark(row) {
    this.set('mark', this.mark < 0 ? row : -1);
  }
}
