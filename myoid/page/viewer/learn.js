// Learning by moving: a muscle's numbers as sliders; the torque follows.
import { contours, ellipses } from './contours.js';
import { numbers as unpacked } from './decode.js';
import { el, select } from './element.js';
import { tension } from './law.js';
import { Plot } from './plot.js';
import { reading } from './texts.js';
import { text } from './series.js';

const SIDE = 250;
const LEFT = 52;
const BASE = 34;

export class Learn {
  constructor(bench) {
    this.bench = bench;
    this.muscles = bench.data.muscles;
    this.muscle = 0;
    this.pair = [0, 2];
    const choose = select('Muscle', this.muscles.map((m) => m.name), (i) => this.open(i));
    this.sliders = el('div', { className: 'sliders' });
    this.fit = el('p', { className: 'fit', attributes: { 'aria-live': 'polite' } });
    this.map = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.map.setAttribute('role', 'img');
    this.pairs = el('span');
    this.caption = el('p', { className: 'caption' });
    this.grid = el('div', { className: 'torques' });
    const back = el('button', { type: 'button', textContent: 'identified', title: 'Back to the identified numbers', onclick: () => this.open(this.muscle) });
    const literature = el('button', { type: 'button', textContent: 'literature', title: 'The literature’s numbers', onclick: () => this.set(this.muscles[this.muscle].literature) });
    this.element = el('figure', { className: 'learn', id: 'learn' },
      el('h3', { textContent: 'What if the muscle were another?' }),
      el('div', { className: 'learn-grid' },
        el('div', {}, el('div', { className: 'row' }, choose, back, literature), this.sliders, this.fit),
        el('div', {}, el('div', { className: 'row' }, this.pairs), this.map, this.caption), this.grid),
      el('details', { className: 'reading' }, el('summary', { textContent: 'How to read this' }), reading('learn')));
    this.map.addEventListener('pointerdown', (event) => this.#drag(event));
    this.map.addEventListener('pointermove', (event) => event.buttons && this.#drag(event));
  }

  openTrial() {
    this.element.hidden = this.bench.trial.data.drives.length === 0;
    if (this.element.hidden) return;
    this.open(this.muscle, this.values);
  }

  /** Shows a muscle; its identified numbers unless others are given. */
  open(index, values) {
    const changed = index !== this.muscle;
    this.muscle = index;
    const { numbers, identified } = this.muscles[index];
    this.values = values && !changed ? values : [...identified];
    this.inputs = numbers.map((n) => {
      const input = el('input', { type: 'range', min: n.lower, max: n.upper, step: (n.upper - n.lower) / 1000, attributes: { 'aria-label': `${n.name} of ${this.muscles[index].name}` } });
      const value = el('output');
      input.addEventListener('input', () => {
        this.values[n.field] = Number(input.value);
        this.update();
      });
      return { input, value, row: el('label', {}, el('span', {}, n.name, el('small', { textContent: ` ${n.verdict}` })), input, value) };
    });
    this.sliders.replaceChildren(...this.inputs.map((i) => i.row));
    const pairs = [[0, 1], [0, 2], [1, 2]];
    const names = pairs.map(([a, b]) => `${numbers[a].name} and ${numbers[b].name}`);
    const choice = select('Numbers of the map', names, (i) => {
      this.pair = pairs[i];
      this.update();
    });
    choice.value = pairs.findIndex(([a, b]) => a === this.pair[0] && b === this.pair[1]);
    this.pairs.replaceChildren(choice);
    this.attach();
  }

  set(values) {
    this.values = [...values];
    this.update();
  }

  /** Makes the torque plots of the trial. */
  attach() {
    const { trial } = this.bench;
    if (!this.values || trial.data.drives.length === 0) return;
    this.torques = trial.plots.filter((p) => p.kind === 'torque' && p.curves.some((c) => c.role === 'identified'));
    this.plots = this.torques.map((p) => {
      const kept = p.curves.filter((c) => c.role === 'reference' || c.role === 'identified');
      const plot = new Plot({ ...p, kind: 'learn', title: p.title, curves: kept, prefix: trial.name, height: 210 }, this.bench.on);
      plot.domain = this.bench.domain;
      plot.view = this.bench.view;
      plot.kept = kept;
      return plot;
    });
    this.grid.replaceChildren(...this.plots.map((p) => p.element));
    this.resize();
    this.update();
  }

  resize() {
    for (const plot of this.plots || []) plot.resize(plot.element.clientWidth);
  }

  setCursor(t) {
    for (const plot of this.plots || []) plot.setCursor(t);
  }

  setPointer(t) {
    for (const plot of this.plots || []) plot.setPointer(t);
  }

  setView(view) {
    for (const plot of this.plots || []) plot.setView(view);
  }

  /** The torque of one joint in a trial if the muscle had these numbers: the identified one with this muscle's part exchanged. */
  moved(trial, identified, joint) {
    const drive = trial.drives[this.muscle];
    const arm = drive.arms[joint];
    const before = this.muscles[this.muscle].identified;
    return identified.y.map((torque, i) => {
      const force = (p) => tension(drive.activation[i], drive.length[i], drive.velocity[i], p);
      return torque + arm[i] * (force(this.values) - force(before));
    });
  }

  update() {
    const { numbers } = this.muscles[this.muscle];
    numbers.forEach((n, k) => {
      const value = this.values[n.field];
      this.inputs[k].input.value = value;
      this.inputs[k].value.textContent = `${Number(value.toPrecision(4))} ${n.unit}`;
    });
    const says = [];
    (this.plots || []).forEach((plot, k) => {
      const measured = plot.kept.find((c) => c.role === 'reference');
      const identified = plot.kept.find((c) => c.role === 'identified');
      const y = this.moved(this.bench.trial, identified, Math.max(0, this.torques[k].joint));
      plot.setCurves([...plot.kept, { name: 'moved', role: 'moved', x: identified.x, y, upper: null, places: identified.places }]);
      says.push(`${this.bench.trial.name}, ${plot.title}: ${text(rms(y, measured.y), 2)} N m rms from the measured torque (identified: ${text(rms(identified.y, measured.y), 2)})`);
    });
    const all = this.#isMoved() ? this.#allTrials() : null;
    if (all) says.push(`all trials: ${text(all.moved, 2)} N m rms (identified: ${text(all.identified, 2)})`);
    this.fit.textContent = `${says.join('; ')}.`;
    this.#map();
  }

  #isMoved() {
    return this.values.some((value, i) => value !== this.muscles[this.muscle].identified[i]);
  }

  #allTrials() {
    const sum = { moved: 0, identified: 0, count: 0 };
    for (const trial of this.bench.trials) {
      if (!trial.data.drives.length) continue;
      for (const p of trial.plots.filter((q) => q.kind === 'torque')) {
        const measured = p.curves.find((c) => c.role === 'reference');
        const identified = p.curves.find((c) => c.role === 'identified');
        if (!identified) continue;
        const y = this.moved(trial, identified, Math.max(0, p.joint));
        for (let i = 0; i < y.length; ++i) {
          sum.moved += (y[i] - measured.y[i]) ** 2;
          sum.identified += (identified.y[i] - measured.y[i]) ** 2;
        }
        sum.count += y.length;
      }
    }
    return sum.count ? { moved: Math.sqrt(sum.moved / sum.count), identified: Math.sqrt(sum.identified / sum.count) } : null;
  }

  /**
   * What the recording allows of the pair of numbers: regions (contours.js), draws if there are any, and the ends of the
   * map along both sides, in which the literature is, too.
   */
  get #allowed() {
    const key = [this.muscle, ...this.pair].join();
    if (this.allowed?.key === key) return this.allowed;
    const m = this.muscles[this.muscle];
    const [ka, kb] = this.pair;
    const shares = [0.95, 0.5];
    const draws = m.draws && [ka, kb].map((k) => unpacked(m.draws.values[k]).values);
    const [a, b] = [ka, kb].map((k) => ({ value: m.identified[m.numbers[k].field], spread: m.numbers[k].sd_log }));
    const regions = draws ? contours(...draws, unpacked(m.draws.weight).values, shares) : ellipses(a, b, m.correlation[ka][kb] || 0, shares);
    const ends = [ka, kb].map((k, side) => {
      const n = m.numbers[k];
      const known = [m.identified[n.field], m.literature[n.field], ...regions.flat(2).map((point) => point[side])];
      const [lower, upper] = [Math.min(...known), Math.max(...known)];
      const margin = 0.12 * (upper - lower || lower);
      return [Math.max(n.lower, lower - margin), Math.min(n.upper, upper + margin)];
    });
    return (this.allowed = { key, draws, regions, ends });
  }

  /** Place of a pair of numbers on the map, in pixels. */
  place(pair) {
    const [x, y] = this.#allowed.ends.map(([lower, upper], side) => (pair[side] - lower) / (upper - lower));
    return [LEFT + x * (SIDE - 8), 8 + (1 - y) * (SIDE - 8)];
  }

  #map() {
    const m = this.muscles[this.muscle];
    const [a, b] = this.pair.map((k) => m.numbers[k]);
    const { draws, regions, ends } = this.#allowed;
    const at = (pair) => this.place(pair).map((p) => p.toFixed(1)).join(' ');
    let out = `<clipPath id="learn-clip"><rect x="${LEFT}" y="8" width="${SIDE - 8}" height="${SIDE - 8}"/></clipPath>` +
      `<rect x="${LEFT}" y="8" width="${SIDE - 8}" height="${SIDE - 8}" fill="#fff" stroke="#8a9097"/><g clip-path="url(#learn-clip)">`;
    if (draws)
      out += `<path d="${Array.from(draws[0], (x, i) => `M${at([x, draws[1][i]])}h0`).join('')}" stroke="#d1491b" stroke-opacity="0.3" stroke-width="2" stroke-linecap="round"/>`;
    for (const lines of regions)
      out += `<path class="allowed" d="${lines.map((line) => `M${line.map(at).join('L')}Z`).join('')}" fill="#d1491b" fill-opacity="0.16" fill-rule="evenodd" stroke="#d1491b"/>`;
    const mark = (values, color, shape, title) => {
      // Beyond the map the mark stays at its edge.
      const [x, y] = this.place([a, b].map((n) => values[n.field])).map((p, k) => Math.max(k ? 14 : LEFT + 6, Math.min(k ? SIDE - 6 : LEFT + SIDE - 14, p)));
      return `<path transform="translate(${x.toFixed(1)} ${y.toFixed(1)})" d="${shape}" fill="none" stroke="${color}" stroke-width="2.2"><title>${title}</title></path>`;
    };
    out += mark(m.literature, '#6b6b6b', 'M-5 -5H5V5H-5Z', 'literature');
    out += mark(m.identified, '#d1491b', 'M-6 0H6M0 -6V6', 'identified');
    out += mark(this.values, '#7b2d8b', 'M-6 0a6 6 0 1 0 12 0a6 6 0 1 0 -12 0Z', 'moved');
    out += '</g>';
    const axis = (n) => `${n.name}${n.unit ? ` [${n.unit}]` : ''}`;
    const base = SIDE + 12;
    const [[a0, a1], [b0, b1]] = ends.map((of) => of.map((v) => Number(v.toPrecision(3))));
    out += `<text x="${LEFT}" y="${base}">${a0}</text><text x="${LEFT + SIDE - 8}" y="${base}" text-anchor="end">${a1}</text>` +
      `<text x="${LEFT + SIDE / 2}" y="${base + 16}" text-anchor="middle">${axis(a)}</text>` +
      `<text x="${LEFT - 4}" y="${SIDE}" text-anchor="end">${b0}</text><text x="${LEFT - 4}" y="18" text-anchor="end">${b1}</text>` +
      `<text transform="translate(12 ${SIDE / 2}) rotate(-90)" text-anchor="middle">${axis(b)}</text>`;
    const width = LEFT + SIDE;
    const height = SIDE + BASE;
    for (const [name, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}`, 'font-size': 10, fill: '#22262b', 'font-family': 'Helvetica, Arial, sans-serif' }))
      this.map.setAttribute(name, value);
    this.map.innerHTML = out;
    this.map.setAttribute('aria-label', `${a.name} and ${b.name} of ${m.name}: correlation ${text(m.correlation[this.pair[0]][this.pair[1]] || 0, 2)} after the recording.`);
    const kinds = draws ? `Points: ${draws[0].length} draws from the posterior. Contours: the 50 % and 95 % of them where they are densest.`
      : 'Contours: 50 % and 95 % of a normal distribution of the logarithms, by standard errors and correlation of the fit.';
    this.caption.textContent = `□ literature, + identified, ○ where you are. ${regions.length ? kinds : 'One of the two numbers was held: there is no contour.'}`;
  }

  #drag(event) {
    const box = this.map.getBoundingClientRect();
    const numbers = this.pair.map((k) => this.muscles[this.muscle].numbers[k]);
    const shares = [(event.clientX - box.left - LEFT) / (SIDE - 8), 1 - (event.clientY - box.top - 8) / (SIDE - 8)];
    numbers.forEach((n, i) => {
      const [lower, upper] = this.#allowed.ends[i];
      this.values[n.field] = lower + Math.max(0, Math.min(1, shares[i])) * (upper - lower);
    });
    this.update();
    event.preventDefault();
  }
}

/** Root mean square of the difference. */
function rms(a, b) {
  let sum = 0;
  for (let i = 0; i < a.length; ++i) sum += (a[i] - b[i]) ** 2;
  return Math.sqrt(sum / a.length);
}
