// The table of a page, sorted by any column and filtered by words; a comparison of two jobs of a study. Without scripts the
// table stays as it was written.
const table = document.getElementById('ranking'), body = table.tBodies[0];
const more = document.getElementById('more-jobs');
// Rows in their order on the page. Of thousands of rows a browser lays out only those that are shown.
const rowsAtOnce = 100;
let rows = [...body.rows, ...(more ? more.content.children : [])], most = rowsAtOnce;
const heads = [...table.tHead.rows[0].cells];
const things = table.dataset.things, areJobs = things === 'jobs';

function made(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

// ---- sorting ----------------------------------------------------------------------------------------------------------

// Returns the number of a cell, else its text; null: no value, always sorted last.
function valueOf(row, column) {
  const cell = row.cells[column];
  if (!cell || cell.colSpan > 1) return null;
  if ('value' in cell.dataset) return cell.dataset.value === '' ? null : Number(cell.dataset.value);
  return cell.textContent.trim().toLowerCase() || null;
}

function sortBy(column, direction) {
  const sign = direction === 'ascending' ? 1 : -1;
  const keyed = rows.map(row => ({row, written: Number(row.dataset.rank), value: valueOf(row, column)}));
  keyed.sort((a, b) => {
    if (a.value === null || b.value === null) return (a.value === null) - (b.value === null) || a.written - b.written;
    const order = typeof a.value === 'string' ? a.value.localeCompare(b.value) : a.value < b.value ? -1 : +(a.value > b.value);
    return sign * order || a.written - b.written;
  });
  rows = keyed.map(entry => entry.row);
  most = rowsAtOnce;
  show();
  heads.forEach((head, k) => head.setAttribute('aria-sort', k === column ? direction : 'none'));
}

heads.forEach((head, column) => {
  const button = made('button', {type: 'button', class: 'sort'});
  button.append(...head.childNodes);
  head.append(button);
  head.setAttribute('aria-sort', 'none');
  // Lives are sorted from the longest, names and ranks from the first.
  const first = head.classList.contains('number') && column > 0 ? 'descending' : 'ascending';
  const other = first === 'ascending' ? 'descending' : 'ascending';
  button.addEventListener('click', () => sortBy(column, head.getAttribute('aria-sort') === first ? other : first));
});
heads[0].setAttribute('aria-sort', 'ascending');

// ---- filtering --------------------------------------------------------------------------------------------------------

const words = made('input', {type: 'search', 'aria-label': `show only ${things} with these words`, placeholder: `filter ${things}`});
const warned = made('input', {type: 'checkbox'});
const count = made('span', {role: 'status'});
const rest = made('p', {class: 'tools'}), texts = new Map();

function textOf(row) {
  if (!texts.has(row)) texts.set(row, row.textContent.toLowerCase());
  return texts.get(row);
}
function button(words, action) {
  const element = made('button', {type: 'button'}, words);
  element.addEventListener('click', action);
  return element;
}
const counted = number => number.toLocaleString('en-US');

// Shows the first of the requested rows.
function show() {
  const wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean);
  const found = rows.filter(
      row => (!warned.checked || Number(row.dataset.warnings) > 0) && (!wanted.length || wanted.every(word => textOf(row).includes(word))));
  const shown = found.slice(0, most);
  if (areJobs) shown.forEach(offerComparison);
  body.replaceChildren(...shown);
  count.textContent = found.length === rows.length ? '' : `${counted(found.length)} of ${counted(rows.length)} ${things}`;
  rest.hidden = shown.length === found.length;
  if (rest.hidden) return;
  const further = number => () => {
    most = shown.length + number;
    show();
  };
  rest.replaceChildren(
      `The first ${counted(shown.length)} of ${counted(found.length)} ${things}. `,
      button(`${Math.min(rowsAtOnce, found.length - shown.length)} more`, further(rowsAtOnce)), button('all', further(Infinity)));
}
function filter() {
  most = rowsAtOnce;
  show();
}
words.addEventListener('input', filter);
warned.addEventListener('change', filter);
const compared = made('section', {id: 'compared', 'aria-live': 'polite'});
const onlyWarned = areJobs ? [made('label', {}, warned, ' with warnings only')] : [];
table.parentElement.before(made('div', {class: 'tools'}, words, ...onlyWarned, count));
table.parentElement.after(rest, compared);

// ---- comparison of two jobs -------------------------------------------------------------------------------------------

// Reads settings in the format of dresslife: "fatigue.stress" -> "cyclic", "dresspack.components.0.count" -> "4".
function settingsOf(text) {
  const values = new Map(), counts = new Map(), stack = [];
  const last = () => stack[stack.length - 1], path = () => stack.map(part => part.key).join('.');
  for (const line of text.split('\n')) {
    let indent = line.search(/\S/), rest = line.trim();
    if (indent < 0) continue;
    for (; rest === '-' || rest.startsWith('- '); rest = rest.slice(2).trimStart(), indent += 2) {
      while (last() && (last().indent > indent || (last().indent === indent && last().item))) stack.pop();
      const list = path(), at = counts.get(list) || 0;
      counts.set(list, at + 1);
      stack.push({indent, key: at, item: true});
    }
    const pair = /^([\w-]+):(?:\s+(.*))?$/.exec(rest);
    if (!pair) {
      values.set(path(), `${values.get(path()) || ''} ${rest}`.trim());
      continue;
    }
    while (last() && last().indent >= indent) stack.pop();
    stack.push({indent, key: pair[1]});
    if (pair[2] !== undefined) values.set(path(), pair[2]);
  }
  return values;
}

const settingsText = row => document.querySelector(`#job-${row.dataset.rank} pre.settings`)?.textContent;

// Works also for a row that is not laid out.
function wordsOf(cell) {
  if (!cell) return '';
  const copy = cell.cloneNode(true);
  for (const end of copy.querySelectorAll('br')) end.replaceWith('\n');
  return copy.textContent.trim();
}

function differences([one, other]) {
  const lines = [];
  for (let column = 2; column < heads.length; ++column) {
    const [a, b] = [one, other].map(row => wordsOf(row.cells[column]) || '-');
    if (a !== b) lines.push([heads[column].innerText, a, b]);
  }
  const texts = [one, other].map(settingsText);
  if (!texts.every(Boolean)) return {lines, settings: null};
  const [a, b] = texts.map(settingsOf), settings = [];
  for (const key of new Set([...a.keys(), ...b.keys()]))
    if (a.get(key) !== b.get(key)) settings.push([key, a.get(key) ?? '-', b.get(key) ?? '-']);
  return {lines, settings};
}

function comparison(caption, lines, names) {
  const cells = (line, tag) => line.map((text, k) => made(k ? tag : 'th', {scope: k ? 'col' : 'row'}, text));
  const body = made('tbody', {}, ...lines.map(line => made('tr', {}, ...cells(line, 'td'))));
  return made('div', {class: 'wide'}, made('table', {}, made('caption', {}, caption),
      made('thead', {}, made('tr', {}, ...cells(['', ...names], 'th'))), body));
}

let picked = [];
function compare() {
  compared.replaceChildren();
  if (picked.length < 2) {
    if (picked.length) compared.append(made('p', {class: 'soft'}, 'Choose a second job to see what differs.'));
    return;
  }
  const names = picked.map(row => row.dataset.job), {lines, settings} = differences(picked);
  compared.append(made('h3', {}, `${names[0]} beside ${names[1]}`), comparison('What differs in the results', lines, names));
  if (settings === null)
    compared.append(made('p', {class: 'soft'}, 'The settings of at least one of them are not on this page (it holds those of ' +
        'the 20 best and the 20 worst): see job.yaml in their folders.'));
  else if (settings.length === 0)
    compared.append(made('p', {class: 'soft'}, 'Their settings are the same.'));
  else
    compared.append(comparison('What differs in the settings', settings, names));
}

function offerComparison(row) {
  if (row.querySelector('.pick')) return;
  const box = made('input', {type: 'checkbox', 'aria-label': `compare ${row.dataset.job}`});
  box.addEventListener('change', () => {
    picked = picked.filter(other => other !== row);
    if (box.checked) picked.push(row);
    if (picked.length > 2) picked.shift().querySelector('.pick input').checked = false;
    compare();
  });
  row.cells[1].prepend(made('label', {class: 'pick', title: 'compare with another job'}, box));
}
show();
document.body.dataset.ready = 'yes';
