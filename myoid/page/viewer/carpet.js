// All channels of a trial at a glance: rows of channels, columns of time, a strong color is high.
import { el } from './element.js';
import { reading } from './texts.js';
import { cell, escape, save, svgFile } from './save.js';
import { text, ticks } from './series.js';

const ROW = 13;
const LEFT = 74;
const TOP = 2;
/** Least value that is drawn dark: a marker 20 mm off its place in the model is far off, one 2 mm off is not. */
const LEAST = { EMG: 0, marker: 20 };

/** How strongly a cell is filled. One color on a pale ground: readable without color and on paper. */
const strength = (share) => Math.sqrt(Math.max(0, Math.min(1, share))).toFixed(2);

export class Carpet {
  /** `on` as of a plot. */
  constructor(on) {
    this.on = on;
    this.svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.svg.setAttribute('role', 'img');
    this.says = el('output');
    const explain = reading('carpet');
    explain.hidden = true;
    const button = (label, title, action) => el('button', { type: 'button', textContent: label, title, onclick: action });
    this.element = el('figure', { className: 'plot carpet', attributes: { 'data-kind': 'carpet', 'data-title': 'channels' } },
      el('div', { className: 'head' }, el('b', { textContent: 'All channels' }), el('span', { className: 'values' }, this.says),
        el('span', { className: 'tools' },
          button('CSV', 'Save the numbers', () => this.saveCsv()), button('SVG', 'Save this drawing', () => this.saveSvg()),
          button('?', 'How to read this', () => (explain.hidden = !explain.hidden)))),
      this.svg, explain);
    this.svg.addEventListener('pointermove', (event) => this.#hover(event));
    this.svg.addEventListener('pointerleave', () => {
      this.says.textContent = this.scale;
      this.on.hover(null);
    });
    this.svg.addEventListener('click', (event) => this.on.pick(this.#time(event)));
    this.svg.addEventListener('dblclick', () => this.on.reset());
  }

  open(trial) {
    this.trial = trial;
    this.element.hidden = trial.carpet.rows.length === 0;
    const top = {};
    for (const row of trial.carpet.rows)
      top[row.kind] = Math.max(top[row.kind] || LEAST[row.kind] || 0, ...[...row.values].filter(Number.isFinite));
    this.top = top;
    this.scale = Object.entries(top).map(([kind, value]) => `${kind === 'marker' ? 'marker error' : kind} ${kind === 'marker' ? `${text(value, 0)} mm` : text(value, 2)}`);
    this.scale = this.scale.length ? `darkest: ${this.scale.join(', ')}` : '';
    this.says.textContent = this.scale;
    this.draw();
  }

  resize(width) {
    if (width === this.width || width < 60) return;
    this.width = width;
    this.draw();
  }

  setView(view) {
    this.view = view;
    this.draw();
  }

  get shown() {
    return this.view || this.domain || [this.trial.carpet.begin, this.trial.carpet.end];
  }

  px(t) {
    const [a, b] = this.shown;
    return LEFT + ((t - a) / (b - a || 1)) * (this.width - LEFT - 8);
  }

  #time(event) {
    const [a, b] = this.shown;
    const here = event.clientX - this.svg.getBoundingClientRect().left;
    return Math.min(b, Math.max(a, a + ((here - LEFT) / (this.width - LEFT - 8)) * (b - a)));
  }

  draw() {
    if (!this.width || !this.trial) return;
    const { rows, begin, end } = this.trial.carpet;
    const base = TOP + ROW * rows.length;
    const height = base + 16;
    const right = this.width - 8;
    let out = '<defs><pattern id="missing" width="5" height="5" patternUnits="userSpaceOnUse"><rect width="5" height="5" fill="#fff"/><path d="M0 5L5 0" stroke="#5a626b"/></pattern>' +
      `<clipPath id="carpet-clip"><rect x="${LEFT}" y="0" width="${right - LEFT}" height="${base}"/></clipPath></defs>`;
    let cells = `<rect x="${LEFT}" width="${right - LEFT}" height="${base}" fill="#f4f6f8"/>`;
    rows.forEach((row, r) => {
      const y = TOP + ROW * r;
      const faulty = this.trial.marks.some((m) => m.about.split(', ').includes(row.name));
      out += `<text x="${LEFT - 5}" y="${y + 10}" text-anchor="end"${faulty ? ' font-weight="bold" fill="#7a4b00"' : ''}>${faulty ? '▲ ' : ''}${escape(row.name.length > 11 ? `${row.name.slice(0, 10)}…` : row.name)}<title>${escape(row.name)}</title></text>`;
      const width = (end - begin) / row.values.length;
      row.values.forEach((value, k) => {
        const x = this.px(begin + k * width);
        const fill = Number.isFinite(value) ? `#102a5c" fill-opacity="${strength(value / (this.top[row.kind] || 1))}` : 'url(#missing)';
        cells += `<rect x="${x.toFixed(1)}" y="${y}" width="${(this.px(begin + (k + 1) * width) - x + 0.4).toFixed(1)}" height="${ROW - 1}" fill="${fill}"/>`;
      });
      for (const mark of this.trial.marks) {
        if (!mark.about.split(', ').includes(row.name)) continue;
        const from = this.px(mark.begin ?? begin);
        cells += `<rect x="${from.toFixed(1)}" y="${y}" width="${Math.max(3, this.px(mark.end ?? end) - from).toFixed(1)}" height="${ROW - 1}" fill="none" stroke="#d95f00" stroke-width="2"><title>${escape(mark.text)}</title></rect>`;
      }
    });
    out += `<g clip-path="url(#carpet-clip)">${cells}</g>`;
    for (const { at, label } of ticks(...this.shown, Math.max(2, this.width / 90)))
      out += `<text x="${this.px(at).toFixed(1)}" y="${base + 12}" text-anchor="middle">${label}</text>`;
    out += `<line class="cursor" y1="0" y2="${base}" stroke="#d1491b" stroke-width="1.4" visibility="hidden"/>`;
    for (const [name, value] of Object.entries({ width: this.width, height, viewBox: `0 0 ${this.width} ${height}`, 'font-size': 10, fill: '#22262b', 'font-family': 'Helvetica, Arial, sans-serif' }))
      this.svg.setAttribute(name, value);
    this.svg.innerHTML = out;
    const missing = rows.filter((r) => [...r.values].some((v) => !Number.isFinite(v))).map((r) => r.name);
    this.svg.setAttribute('aria-label', `${rows.length} channels over time. ${missing.length ? `Missing in part: ${missing.join(', ')}.` : 'None is missing.'} ${this.trial.marks.map((m) => m.text).join('. ')}`);
    this.cursorLine = this.svg.querySelector('.cursor');
    this.setCursor(this.cursor);
  }

  setCursor(t) {
    this.cursor = t;
    if (!this.cursorLine) return;
    const hidden = t === null || t === undefined || t < this.shown[0] || t > this.shown[1];
    this.cursorLine.setAttribute('visibility', hidden ? 'hidden' : 'visible');
    if (hidden) return;
    this.cursorLine.setAttribute('x1', this.px(t));
    this.cursorLine.setAttribute('x2', this.px(t));
  }

  setPointer(t) {
    this.setCursorOnly = t;
  }

  #hover(event) {
    const t = this.#time(event);
    const row = this.trial.carpet.rows[Math.floor((event.clientY - this.svg.getBoundingClientRect().top - TOP) / ROW)];
    const { begin, end } = this.trial.carpet;
    if (row) {
      const k = Math.max(0, Math.min(row.values.length - 1, Math.floor(((t - begin) / (end - begin)) * row.values.length)));
      const value = row.values[k];
      const says = this.trial.marks.filter((m) => m.about.split(', ').includes(row.name)).map((m) => m.text);
      this.says.textContent = [`${row.name}, ${text(t, 2)} s: ${Number.isFinite(value) ? `${text(value, row.places)} ${row.unit}` : 'missing'}`, ...says].join(' · ');
    }
    this.on.hover(t);
  }

  saveCsv() {
    const { rows, begin, end } = this.trial.carpet;
    const lines = ['channel,kind,unit,begin_s,end_s,greatest'];
    for (const row of rows) {
      const width = (end - begin) / row.values.length;
      row.values.forEach((v, k) => lines.push(`${cell(row.name)},${row.kind},${row.unit},${(begin + k * width).toFixed(4)},${(begin + (k + 1) * width).toFixed(4)},${Number.isFinite(v) ? Number(v.toPrecision(6)) : ''}`));
    }
    save(`${this.trial.name}_channels.csv`, lines.join('\n') + '\n', 'text/csv');
  }

  saveSvg() {
    save(`${this.trial.name}_channels.svg`, svgFile(this.svg, `All channels of ${this.trial.name}`), 'image/svg+xml');
  }
}
