// SPDX-License-Identifier: Apache-2.0
// Without this the page shows every scenario with its static pictures; with it, one at a time.

// The page's own ids begin with a slash, which no scenario's name holds.
const explorers = new Map();

// The scenario that the address names; a wrong address names none.
function addressed(sections) {
  try {
    const name = decodeURIComponent(location.hash.slice(1));
    return sections.find((s) => s.id === name);
  } catch {
    return undefined;
  }
}

function makePicker(sections) {
  const nav = document.createElement('nav');
  const select = element(nav, 'select');
  select.setAttribute('aria-label', 'scenario');
  for (const s of sections) element(select, 'option', '', s.id + ' (' + s.querySelector('.badge').textContent + ')').value = s.id;
  select.addEventListener('change', () => { location.hash = encodeURIComponent(select.value); });
  for (const [text, step] of [['Previous', -1], ['Next', 1]])
    element(nav, 'button', '', text).addEventListener('click', () => {
      const i = (select.selectedIndex + step + sections.length) % sections.length;
      location.hash = encodeURIComponent(sections[i].id);
    });
  document.querySelector('main').prepend(nav);
  return select;
}

async function explore(section, report) {
  if (explorers.has(section.id)) return;
  explorers.set(section.id, null);
  const packed = document.querySelector('script[data-scenario="' + CSS.escape(section.id) + '"]');
  const facts = report.scenarios.find((s) => s.name === section.id);
  if (!packed || !section.querySelector('.live')) {
    section.classList.add('plain');
    return;
  }
  explorers.set(section.id, new Explorer(section, await decodeScenario(packed), facts));
}

async function start() {
  document.querySelectorAll('table.sortable').forEach(makeSortable);
  const sections = [...document.querySelectorAll('.scenario')];
  if (typeof DecompressionStream === 'undefined' || sections.length === 0) return;
  const report = JSON.parse(new TextDecoder().decode(await inflate(document.getElementById('/report-json').textContent)));
  const select = makePicker(sections);
  document.documentElement.classList.add('scripted');
  const worst = report.scenarios.find((s) => s.verdict === 'fail' || s.verdict === 'invalid') || report.scenarios[0];
  const show = async () => {
    const wanted = addressed(sections);
    const current = wanted || sections.find((s) => s.classList.contains('shown')) || sections.find((s) => s.id === worst.name);
    sections.forEach((s) => s.classList.toggle('shown', s === current));
    select.value = current.id;
    await explore(current, report);
    if (wanted) document.querySelector('main').scrollIntoView();
  };
  window.addEventListener('hashchange', show);
  document.getElementById('/json').addEventListener('click', (e) => {
    e.preventDefault();
    saveJson();
  });
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () =>
    explorers.forEach((e) => { if (e) e.restyle(); }));
  await show();
  document.documentElement.dataset.ready = 'yes';
}

start();
