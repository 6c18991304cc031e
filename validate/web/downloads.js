// SPDX-License-Identifier: Apache-2.0
// Files made of what the page holds.

function save(name, type, text) {
  const link = element(document.body, 'a');
  link.href = URL.createObjectURL(new Blob([text], {type}));
  link.download = name;
  link.click();
  link.remove();
}

async function saveJson() {
  save('report.json', 'application/json', await inflate(document.getElementById('/report-json').textContent));
}

// The traces as they stand here: to some 7 digits; the files beside the page hold 17.
function csvText(data, labels, columns) {
  const table = [data.time], head = ['time'];
  for (const name of columns) {
    table.push(data.column('reference', name), data.candidate(name), data.column('residual', name));
    head.push(labels[0] + '.' + name, labels[1] + '.' + name, 'residual.' + name);
  }
  const lines = [head.join(',')];
  for (let k = 0; k < data.rows; k++) lines.push(table.map((c) => +c[k].toPrecision(9)).join(','));
  return lines.join('\n') + '\n';
}
