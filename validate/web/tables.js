// SPDX-License-Identifier: Apache-2.0
// Tables of class "sortable": a click on a header sorts by its column, another the other way.

// Numbers before texts; "exact" is a margin beyond all others, "-" one that is not there.
function sortKey(cell) {
  const text = cell ? cell.textContent.trim() : '';
  if (text === 'exact') return Infinity;
  const failing = /^(\d+) of \d+ fail$/.exec(text);
  if (failing) return -failing[1]; // before any margin
  const number = parseFloat(text);
  return Number.isNaN(number) || /^\d+-/.test(text) ? text : number;
}

function compareKeys(a, b) {
  if (typeof a === typeof b) return a < b ? -1 : a > b ? 1 : 0;
  return typeof a === 'number' ? -1 : 1;
}

function sortTable(table, column) {
  const headers = [...table.tHead.rows[0].cells], body = table.tBodies[0];
  const rising = headers[column].getAttribute('aria-sort') !== 'ascending';
  const rows = [...body.rows].map((row) => [sortKey(row.cells[column]), row]);
  rows.sort((a, b) => (rising ? 1 : -1) * compareKeys(a[0], b[0]));
  headers.forEach((h, i) => h.setAttribute('aria-sort', i !== column ? 'none' : rising ? 'ascending' : 'descending'));
  body.append(...rows.map((r) => r[1]));
}

function makeSortable(table) {
  [...table.tHead.rows[0].cells].forEach((header, column) => {
    header.setAttribute('aria-sort', 'none');
    header.tabIndex = 0;
    header.title = 'Sort';
    header.addEventListener('click', () => sortTable(table, column));
    header.addEventListener('keydown', (e) => {
      if (e.key === 'Enter') sortTable(table, column);
    });
  });
}
