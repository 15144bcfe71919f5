// The report's sections below the workbench, folded on screen: what one asks for opens. Paper has everything.
import { el } from './element.js';

const OPEN = new Set(['voluntary', 'numbers', 'workbench', 'quality', 'recordings', 'parameters', 'next']);
const LONG = 8;  // rows of a table that is not folded, at most

function fold(box, heading, open) {
  box.classList.add('folds');
  const button = el('button', { type: 'button', className: 'fold' }, ...heading.childNodes);
  const show = (on) => {
    box.classList.toggle('folded', !on);
    button.setAttribute('aria-expanded', on);
  };
  button.addEventListener('click', () => show(box.classList.contains('folded')));
  heading.append(button);
  show(open);
  return show;
}

/** Opens the section that an element is in. */
export function unfold(element) {
  for (let box = element.closest('.folded'); box; box = box.parentElement.closest('.folded')) {
    box.classList.remove('folded');
    box.querySelector('.fold').setAttribute('aria-expanded', true);
  }
}

/** Questions about the recording that were answered well open on request. */
function foldAnswered(table) {
  const rows = [...table.querySelectorAll('tbody tr')].filter((row) => row.querySelector('.badge.pass, .badge.info'));
  if (rows.length < 3) return;
  const body = el('tbody', {}, ...rows);
  const button = el('button', { type: 'button', className: 'fold', textContent: `${rows.length} more: answered well` });
  const head = el('tbody', { className: 'live-only' }, el('tr', {}, el('td', { colSpan: 5 }, button)));
  const show = (on) => {
    body.classList.toggle('answered', !on);
    head.classList.toggle('closed', !on);
    button.setAttribute('aria-expanded', on);
  };
  button.addEventListener('click', () => show(body.classList.contains('answered')));
  table.append(head, body);
  show(false);
}

export function foldSections() {
  for (const table of document.querySelectorAll('.gates table')) foldAnswered(table);
  for (const section of document.querySelectorAll('main > section:not(#workbench)')) {
    for (const heading of [...section.querySelectorAll(':scope > h3')]) {
      const box = el('div');
      heading.before(box);
      let next = heading;
      do {
        const here = next;
        next = here.nextElementSibling;
        box.append(here);
      } while (next && !['H3', 'FIGURE'].includes(next.tagName));
      fold(box, heading, box.querySelectorAll('tbody tr').length <= LONG && !heading.id.startsWith('nuisances'));
    }
    const heading = section.querySelector(':scope > h2');
    if (heading) fold(section, heading, OPEN.has(heading.id));
  }
}
