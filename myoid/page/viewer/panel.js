// Everything beside and below the picture, as plain HTML elements.
import { css, gradient } from './colors.js';
import { el, select } from './element.js';
import { PARTS } from './figure.js';
import { number } from './replay.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 2];

export const KEYS = [
  ['Space', 'play, pause'],
  [', .', 'one frame back, on'],
  ['Home End', 'first, last frame'],
  ['1 2 3 0', 'front, side, top, oblique'],
  ['← → ↑ ↓', 'turn'],
  ['Shift + arrow', 'move'],
  ['+ −', 'nearer, farther'],
  ['F', 'all in view'],
  ...PARTS.map(([, label, key]) => [key.toUpperCase(), `${label.toLowerCase()} on, off`]),
  ['?', 'this list'],
];

const section = (title, ...children) => el('section', {}, el('h2', { textContent: title }), ...children);

function checkbox(label, checked, changed) {
  const input = el('input', { type: 'checkbox', checked });
  input.addEventListener('change', () => changed(input.checked));
  return { input, row: el('label', { className: 'check' }, input, el('span', { textContent: label })) };
}

export class Panel {
  /** `viewer` has what the elements act on; see main.js. */
  constructor(viewer) {
    this.viewer = viewer;
    this.canvas = el('canvas', { tabIndex: 0, attributes: { 'aria-label': 'The model; drag to turn it' } });
    this.tip = el('div', { className: 'tip', hidden: true });
    this.legend = el('div', { className: 'legend', hidden: true });
    this.stage = el('main', {}, this.canvas, this.legend, this.#views(), this.tip);
    this.side = el('aside', {}, ...this.#side());
    document.body.append(this.stage, this.side, this.#transport(), this.#help());
  }

  #views() {
    const buttons = ['front', 'side', 'top', 'oblique'].map((name) =>
      el('button', { type: 'button', textContent: name, onclick: () => this.viewer.view(name) })
    );
    buttons.push(el('button', { type: 'button', textContent: 'fit', title: 'All in view (F)', onclick: () => this.viewer.fit() }));
    buttons.push(el('button', { type: 'button', textContent: '?', title: 'Keys', onclick: () => this.toggleHelp() }));
    return el('nav', { attributes: { 'aria-label': 'View' } }, ...buttons);
  }

  #side() {
    const { title, subtitle, scenes } = this.viewer;
    const parts = [el('h1', { textContent: title.replaceAll('_', '_\u200b') }), el('p', { className: 'subtitle', textContent: subtitle })];
    this.trial = select('Trial', scenes.map((t) => t.name), (i) => this.viewer.openTrial(i));
    if (scenes.length > 1) parts.push(section('Trial', this.trial));
    this.notes = el('ul', { className: 'notes' });
    this.noteCount = el('summary');
    this.noteSection = el('details', {}, this.noteCount, this.notes);
    parts.push(this.noteSection);
    this.colorSection = section('Muscle color');
    parts.push(this.colorSection);
    this.show = el('div', { className: 'checks' });
    parts.push(section('Show', this.show));
    this.coordinates = el('tbody');
    this.coordinateSection = section('Coordinates', el('table', {}, this.coordinates));
    this.muscles = el('div');
    parts.push(this.coordinateSection, this.muscles);
    return parts;
  }

  #muscles(model) {
    const filter = el('input', { type: 'search', placeholder: 'find', attributes: { 'aria-label': 'Find a muscle' } });
    this.rows = model.muscles.map((muscle, m) => {
      const { input, row } = checkbox(muscle.name, true, (on) => this.viewer.showMuscle(m, on));
      const swatch = el('i');
      const value = el('output');
      row.prepend(swatch);
      row.append(value);
      row.addEventListener('pointerenter', () => this.viewer.highlight(m));
      row.addEventListener('pointerleave', () => this.viewer.highlight(-1));
      return { input, row, swatch, value };
    });
    const listed = () => this.rows.filter((r) => !r.row.hidden);
    filter.addEventListener('input', () => {
      const wanted = filter.value.toLowerCase();
      this.rows.forEach((r, m) => (r.row.hidden = !model.muscles[m].name.toLowerCase().includes(wanted)));
    });
    const all = (on) => listed().forEach((r) => {
      r.input.checked = on;
      this.viewer.showMuscle(this.rows.indexOf(r), on);
    });
    return section(
      `Muscles (${model.muscles.length})`,
      el('div', { className: 'tools' }, filter,
        el('button', { type: 'button', textContent: 'all', onclick: () => all(true) }),
        el('button', { type: 'button', textContent: 'none', onclick: () => all(false) })),
      el('div', { className: 'muscles' }, ...this.rows.map((r) => r.row))
    );
  }

  #transport() {
    const { player } = this.viewer;
    this.play = el('button', { type: 'button', className: 'play', onclick: () => player.toggle() });
    this.scrub = el('input', { type: 'range', min: 0, step: 'any', attributes: { 'aria-label': 'Time' } });
    this.scrub.addEventListener('input', () => {
      player.playing = false;
      player.seek(Number(this.scrub.value));
    });
    this.time = el('output', { className: 'time' });
    const speed = select('Speed', SPEEDS.map((s) => `${s} ×`), (i) => (player.speed = SPEEDS[i]));
    speed.value = SPEEDS.indexOf(1);
    const loop = checkbox('loop', true, (on) => (player.loop = on));
    this.follow = checkbox('follow', false, (on) => (this.viewer.follow = on));
    this.follow.row.title = 'The view goes along with the mass center';
    this.transport = el('footer', {}, this.play, this.scrub, this.time, speed, loop.row, this.follow.row);
    return this.transport;
  }

  #help() {
    const rows = KEYS.map(([key, what]) => el('tr', {}, el('th', { textContent: key }), el('td', { textContent: what })));
    this.help = el('dialog', {},
      el('h2', { textContent: 'Keys' }), el('table', {}, ...rows),
      el('p', { textContent: 'Drag to turn, right or shift drag to move, wheel to zoom. Point at anything for its name.' }),
      el('p', { className: 'subtitle', textContent: 'Drawn with three.js (MIT); its licence is at the top of this page’s source.' }),
      el('form', { method: 'dialog' }, el('button', { textContent: 'close' })));
    return this.help;
  }

  toggleHelp() {
    if (this.help.open) this.help.close();
    else this.help.showModal();
  }

  /** Makes the elements those of a trial. */
  openTrial(trial, index, parts) {
    this.trial.value = index;
    this.notes.replaceChildren(...trial.notes.map((n) => el('li', { textContent: n })));
    this.noteCount.textContent = trial.notes.length === 1 ? '1 note' : `${trial.notes.length} notes`;
    this.noteSection.hidden = trial.notes.length === 0;
    this.transport.hidden = trial.frames < 2;
    document.body.classList.toggle('still', trial.frames < 2);
    this.scrub.max = trial.duration;
    const names = trial.values.map((v) => (v.unit ? `${v.name} [${v.unit}]` : v.name));
    this.color = select('Muscle color', [...names, 'one color'], (i) => this.viewer.paintBy(i));
    this.colorSection.hidden = names.length === 0;
    this.colorSection.replaceChildren(this.colorSection.firstChild, this.color);
    this.boxes = {};
    const rows = parts.map(([part, label, on]) => {
      const box = checkbox(label, on, (checked) => this.viewer.show(part, checked));
      this.boxes[part] = box.input;
      return box.row;
    });
    this.show.replaceChildren(...rows);
    const { model } = trial;
    this.muscles.replaceChildren(this.#muscles(model));
    this.muscles.hidden = model.muscles.length === 0;
    this.coordinateSection.hidden = model.coordinates.length === 0;
    this.coordinates.replaceChildren(
      ...model.coordinates.map((c) =>
        el('tr', {}, el('td', { textContent: c.name }), el('td', { className: 'number' }), el('td', { textContent: c.unit === 'deg' ? '°' : c.unit })))
    );
  }

  showLegend(values) {
    this.legend.hidden = !values;
    if (!values) return;
    const ticks = [0, 0.25, 0.5, 0.75, 1].map((share) => el('span', { textContent: tick(share * values.top) }));
    const bar = el('div', { className: 'bar' });
    bar.style.background = gradient();
    this.legend.replaceChildren(
      el('div', { textContent: values.unit ? `${values.name} [${values.unit}]` : values.name }),
      bar,
      el('div', { className: 'ticks' }, ...ticks)
    );
  }

  /** What changes from frame to frame. */
  update(figure, values) {
    const { player, trial } = this.viewer;
    const frame = figure.frame;
    this.play.textContent = player.playing ? '❚❚' : '►';
    this.play.setAttribute('aria-label', player.playing ? 'Pause' : 'Play');
    this.scrub.value = player.seconds;
    const time = trial.times[frame];
    this.time.textContent = `${time.toFixed(3)} s · frame ${frame + 1} of ${trial.frames}`;
    [...this.coordinates.children].forEach((row, c) => (row.children[1].textContent = number(trial.coordinate(frame, c))));
    this.rows.forEach((row, m) => {
      row.swatch.style.background = css(figure.muscleColor(values, m));
      row.value.textContent = values ? number(trial.value(values, frame, m)) : '';
    });
  }

  showTip(text, x, y) {
    this.tip.hidden = !text;
    if (!text) return;
    this.tip.textContent = text;
    this.tip.style.transform = `translate(${x + 14}px, ${y + 10}px)`;
  }
}

/** A round number as it is read off a scale. */
function tick(value) {
  if (value === 0) return '0';
  const digits = Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value))));
  return String(Number(value.toFixed(digits)));
}
