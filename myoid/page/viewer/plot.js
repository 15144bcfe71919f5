// One drawing of curves: read off by pointing, zoomed by dragging, saved as CSV and SVG.
import {el} from './element.js';
import {csv, escape, save, svgFile} from './save.js';
import {nearest, text, ticks} from './series.js';
import {reading} from './texts.js';

/** As in the static figures (svg_plot.cpp): the meaning of a curve decides its look. */
const STYLES = {
  reference: {color: '#1f5fa8', dash: '', width: 1.7},
  literature: {color: '#6b6b6b', dash: '2 3', width: 1.5},
  identified: {color: '#d1491b', dash: '6 3', width: 1.8},
  truth: {color: '#111', dash: '', width: 1.2},
  unseen: {color: '#00694b', dash: '7 2 1.5 2', width: 1.6},
  moved: {color: '#7b2d8b', dash: '', width: 2.2},
  other: {color: '#868d95', dash: '', width: 1.3},
  raw: {color: '#8d959e', area: 0.55},
  band: {color: '#d1491b', area: 0.16},
  range: {color: '#5a626b', area: 0.13},
  norm: {color: '#3d8fc4', area: 0.18, edge: '2 2'},
  spread: {color: '#5a626b', area: 0.22},
};
/** Of channels side by side: colors that the color-blind can tell apart, and dashes. */
const CHANNELS =
    ['#1f5fa8', '#d1491b', '#00694b', '#b86e00', '#7b2d8b', '#3d8fc4', '#5a626b', '#a05a74'];
const DASHES = ['', '7 3', '2 2', '9 2 2 2'];

const LEFT = 50;
const RIGHT = 8;
const TOP = 6;

export class Plot {
  /**
   * `spec`: kind, title, unit, file; curves (series.js); x { label, unit }; height; marks { from,
   * to, text }. `on`: hover(x or null), pick(x), zoom(from, to), reset().
   */
  constructor(spec, on) {
    Object.assign(this, {height: 128, marks: [], x: {label: 'time', unit: 's'}, ...spec});
    this.#align();
    this.on = on;
    this.channels = this.curves.length > 1 && this.curves.every((c) => c.role === 'reference');
    this.values = el('span', {className: 'values'});
    this.svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    this.svg.setAttribute('role', 'img');
    this.shown = this.extent;
    this.svg.setAttribute('aria-label', this.#summary());
    const unit = this.unit ? ` [${this.unit}]` : '';
    const explain = reading(this.kind);
    const button = (label, title, action) =>
        el('button', {type: 'button', textContent: label, title, onclick: action});
    this.element = el(
        'figure',
        {className: 'plot', attributes: {'data-kind': this.kind, 'data-title': this.title}},
        el('div', {className: 'head'}, el('b', {textContent: this.title + unit}), this.values,
           el('span', {className: 'tools'},
              button('CSV', 'Save the numbers of this plot', () => this.saveCsv()),
              button('SVG', 'Save this drawing', () => this.saveSvg()),
              explain ? button('?', 'How to read this', () => (explain.hidden = !explain.hidden)) :
                        '')),
        this.svg);
    if (explain) {
      explain.hidden = true;
      this.element.append(explain);
    }
    this.#readouts();
    this.#listen();
  }

  setCurves(curves) {
    this.curves = curves;
    this.#align();
    this.#readouts();
    this.draw();
  }

  /** Gives all curves the decimals of the coarsest. */
  #align() {
    const least =
        Math.min(...this.curves.filter((c) => c.role !== 'range').map((c) => c.places ?? 3));
    this.curves = this.curves.map((c) => ({...c, places: least}));
  }

  /** The whole extent of the curves along x. */
  get extent() {
    const ends = this.curves.flatMap((c) => (c.x.length ? [c.x[0], c.x[c.x.length - 1]] : []));
    return ends.length ? [Math.min(...ends), Math.max(...ends)] : [0, 1];
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

  px(x) {
    const [a, b] = this.shown;
    return LEFT + ((x - a) / (b - a || 1)) * (this.width - LEFT - RIGHT);
  }

  py(y) {
    const [a, b] = this.range;
    return TOP + (1 - (y - a) / (b - a)) * (this.height - TOP - this.bottom);
  }

  atPixel(px) {
    const [a, b] = this.shown;
    return Math.min(b, Math.max(a, a + ((px - LEFT) / (this.width - LEFT - RIGHT)) * (b - a)));
  }

  /** Look of a curve: by its meaning, or by its number among channels. */
  style(curve, index) {
    if (!this.channels || curve.role === 'other') return STYLES[curve.role] || STYLES.reference;
    return {
      color: CHANNELS[index % CHANNELS.length],
      dash: DASHES[Math.floor(index / 2) % DASHES.length],
      width: 1.6
    };
  }

  draw() {
    if (!this.width) return;
    this.bottom = this.x.label === 'time' ? 16 : 32;
    this.shown = this.view || this.domain || this.extent;
    this.range = this.#range();
    const [a, b] = this.shown;
    const {width, height} = this;
    const right = width - RIGHT;
    const base = height - this.bottom;
    let out = '';
    for (const {at, label} of ticks(a, b, Math.max(2, width / 90))) {
      const x = this.px(at).toFixed(1);
      out += `<line x1="${x}" x2="${x}" y1="${TOP}" y2="${base}" stroke="#e6e8eb"/>`;
      out += `<text x="${x}" y="${base + 12}" text-anchor="middle">${label}</text>`;
    }
    for (const {at, label} of ticks(...this.range, Math.max(3, height / 30))) {
      const y = this.py(at).toFixed(1);
      out += `<line x1="${LEFT}" x2="${right}" y1="${y}" y2="${y}" stroke="${
          Math.abs(at) < 1e-12 ? '#b5bac0' : '#e6e8eb'}"/>`;
      out += `<text x="${LEFT - 5}" y="${Number(y) + 3.5}" text-anchor="end">${label}</text>`;
    }
    if (this.bottom > 20)
      out +=
          `<text x="${(LEFT + right) / 2}" y="${height - 3}" text-anchor="middle" font-size="11">${
              escape(this.x.label)}${this.x.unit ? ` [${escape(this.x.unit)}]` : ''}</text>`;
    const clip = `clip-${(Plot.count = (Plot.count || 0) + 1)}`;
    out += `<clipPath id="${clip}"><rect x="${LEFT}" y="${TOP}" width="${right - LEFT}" height="${
        base - TOP}"/></clipPath><g clip-path="url(#${clip})">`;
    for (const {from, to, text: says} of this.marks) {
      const x = this.px(from);
      out += `<rect x="${x.toFixed(1)}" y="${TOP}" width="${
          Math.max(2, this.px(to) - x).toFixed(1)}" height="${
          base - TOP}" fill="#b86e00" fill-opacity="0.14"><title>${escape(says)}</title></rect>`;
    }
    this.curves.forEach((c, i) => (out += this.#path(c, this.style(c, i))));
    out += '</g>';
    out += `<rect x="${LEFT}" y="${TOP}" width="${right - LEFT}" height="${
        base - TOP}" fill="none" stroke="#8a9097" stroke-width="0.8"/>`;
    out += `<rect class="selection" y="${TOP}" height="${
        base - TOP}" fill="#1f5fa8" fill-opacity="0.15" visibility="hidden"/>`;
    out += `<line class="cursor" y1="${TOP}" y2="${
        base}" stroke="#22262b" stroke-width="1.2" visibility="hidden"/>`;
    out += `<line class="pointer" y1="${TOP}" y2="${
        base}" stroke="#22262b" stroke-dasharray="2 2" visibility="hidden"/>`;
    for (const [name, value] of Object.entries({
           width,
           height,
           viewBox: `0 0 ${width} ${height}`,
           'font-size': 10,
           fill: '#22262b',
           'font-family': 'Helvetica, Arial, sans-serif'
         }))
      this.svg.setAttribute(name, value);
    this.svg.innerHTML = out;
    this.svg.setAttribute('aria-label', this.#summary());
    this.cursorLine = this.svg.querySelector('.cursor');
    this.pointerLine = this.svg.querySelector('.pointer');
    this.selection = this.svg.querySelector('.selection');
    this.setCursor(this.cursor);
  }

  /** Least and greatest value of the curves that are shown. */
  #ends(curves) {
    const [a, b] = this.shown;
    let lower = Infinity;
    let upper = -Infinity;
    for (const c of curves) {
      for (let i = 0; i < c.x.length; ++i) {
        if (c.x[i] < a || c.x[i] > b || !Number.isFinite(c.y[i])) continue;
        lower = Math.min(lower, c.y[i]);
        upper = Math.max(upper, c.upper ? c.upper[i] : c.y[i]);
      }
    }
    return [lower, upper];
  }

  /** What the drawing covers: the literature's curve at most as far again as all others. */
  #range() {
    const all = this.curves.filter((c) => c.role !== 'other' || c.own || this.curves.length === 1);
    let [lower, upper] = this.#ends(all.filter((c) => c.role !== 'literature'));
    const reach = upper - lower;
    const [least, most] = this.#ends(all.filter((c) => c.role === 'literature'));
    if (!(lower <= upper)) [lower, upper] = [least, most];
    else if (least <= most) [lower, upper] = [Math.max(lower - reach, Math.min(lower, least)), Math.min(upper + reach, Math.max(upper, most))];
    if (!(lower <= upper)) return [0, 1];
    const margin = 0.06 * (upper - lower || Math.abs(upper) || 1);
    return [lower >= 0 && lower < margin ? Math.min(0, lower) : lower - margin, upper + margin];
  }

  #path(c, style) {
    let path = '';
    let down = false;
    const [a, b] = this.shown;
    const from = Math.max(0, nearest(c.x, a) - 1);
    const to = Math.min(c.x.length - 1, nearest(c.x, b) + 1);
    for (let i = from; i <= to; ++i) {
      if (!Number.isFinite(c.y[i])) {
        down = false;
        continue;
      }
      path += `${down ? 'L' : 'M'}${this.px(c.x[i]).toFixed(1)} ${this.py(c.y[i]).toFixed(1)}`;
      down = true;
    }
    if (!c.upper)
      return `<path d="${path}" fill="none" stroke="${style.color}" stroke-width="${
          style.width}" stroke-linejoin="round"${
          style.dash ? ` stroke-dasharray="${style.dash}"` : ''}/>`;
    for (let i = to; i >= from; --i)
      if (Number.isFinite(c.upper[i]))
        path += `L${this.px(c.x[i]).toFixed(1)} ${this.py(c.upper[i]).toFixed(1)}`;
    return `<path d="${path}Z" fill="${style.color}" fill-opacity="${style.area || 0.16}"${
        style.edge ? ` stroke="${style.color}" stroke-dasharray="${style.edge}"` : ''}/>`;
  }

  /** The legend, with a place for each curve's value. */
  #readouts() {
    this.readouts = this.curves.map((c, i) => {
      const style = this.style(c, i);
      const value = el('output');
      const swatch = c.upper ?
          `<rect y="2" width="20" height="8" fill="${style.color}" fill-opacity="${
              Math.max(0.3, style.area || 0)}"/>` :
          `<line x2="20" y1="6" y2="6" stroke="${style.color}" stroke-width="2"${
              style.dash ? ` stroke-dasharray="${style.dash}"` : ''}/>`;
      const entry =
          el('span', {
            className: 'entry',
            title: c.name,
            innerHTML: `<svg width="20" height="12" aria-hidden="true">${swatch}</svg>`
          },
             el('span', {className: 'name', textContent: c.name}), value);
      return {entry, value};
    });
    this.values.replaceChildren(...this.readouts.map((r) => r.entry));
    this.read(this.cursor);
  }

  /** Writes the values at x beside the names; the x of the sample that is read. */
  read(x) {
    if (x === undefined || x === null) return null;
    let at = null;
    this.curves.forEach((c, i) => {
      const outside = !c.x.length || x < c.x[0] - 1e-9 || x > c.x[c.x.length - 1] + 1e-9;
      const k = outside ? -1 : nearest(c.x, x);
      const places = c.places ?? 3;
      const value = this.readouts[i].value;
      if (c.role === 'range') return;
      if (k < 0)
        value.textContent = '–';
      else
        value.textContent = c.upper ? `${text(c.y[k], places)} to ${text(c.upper[k], places)}` :
                                      text(c.y[k], places);
      if (k >= 0 && at === null) at = c.x[k];
    });
    return at;
  }

  setCursor(x) {
    this.cursor = x;
    this.#line(this.cursorLine, x);
    this.read(x);
  }

  setPointer(x) {
    this.#line(this.pointerLine, x);
    this.read(x === null ? this.cursor : x);
  }

  #line(line, x) {
    if (!line || !this.shown) return;
    const hidden = x === null || x === undefined || x < this.shown[0] || x > this.shown[1];
    line.setAttribute('visibility', hidden ? 'hidden' : 'visible');
    if (hidden) return;
    line.setAttribute('x1', this.px(x));
    line.setAttribute('x2', this.px(x));
  }

  #listen() {
    let start = null;
    const place = (event) => event.clientX - this.svg.getBoundingClientRect().left;
    this.svg.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      start = place(event);
      if (event.pointerType === 'mouse' && event.isTrusted)
        this.svg.setPointerCapture(event.pointerId);
    });
    this.svg.addEventListener('pointermove', (event) => {
      const here = place(event);
      if (start !== null && Math.abs(here - start) > 4) {
        this.selection.setAttribute('visibility', 'visible');
        this.selection.setAttribute('x', Math.max(LEFT, Math.min(start, here)));
        this.selection.setAttribute('width', Math.abs(here - start));
      }
      this.on.hover(this.atPixel(here));
    });
    this.svg.addEventListener('pointerup', (event) => {
      if (start === null) return;
      const here = place(event);
      const from = start;
      start = null;
      this.selection.setAttribute('visibility', 'hidden');
      if (Math.abs(here - from) > 4)
        this.on.zoom(...[this.atPixel(from), this.atPixel(here)].sort((p, q) => p - q));
      else
        this.on.pick(this.atPixel(here));
    });
    this.svg.addEventListener('pointerleave', () => this.on.hover(null));
    this.svg.addEventListener('pointercancel', () => (start = null));
    this.svg.addEventListener('dblclick', () => this.on.reset());
  }

  /** The drawing in words, for those who do not see it. */
  #summary() {
    const parts = this.curves.filter((c) => c.role !== 'range').map((c) => {
      const finite = [...c.y].filter(Number.isFinite);
      if (!finite.length) return `${c.name}: no values`;
      const places = c.places ?? 3;
      const least = finite.reduce((p, q) => Math.min(p, q), Infinity);
      const top =
          [...(c.upper || c.y)].filter(Number.isFinite).reduce((p, q) => Math.max(p, q), -Infinity);
      return `${c.name}: ${text(least, places)} to ${text(top, places)}`;
    });
    return `${this.title}${this.unit ? ` in ${this.unit}` : ''}, ${this.x.label} ${
        text(this.shown[0], 2)} to ${text(this.shown[1], 2)} ${this.x.unit}. ${parts.join('; ')}.`;
  }

  get fileName() {
    return `${this.prefix ? `${this.prefix}_` : ''}${this.kind}_${this.title}`.replace(
        /[^A-Za-z0-9_.-]+/g, '_');
  }

  saveCsv() {
    save(`${this.fileName}.csv`, csv([{title: this.title, curves: this.curves}]), 'text/csv');
  }

  saveSvg() {
    const legend = this.curves.map((c) => c.name).join(', ');
    save(
        `${this.fileName}.svg`,
        svgFile(this.svg, `${this.title}${this.unit ? ` [${this.unit}]` : ''}: ${legend}`),
        'image/svg+xml');
  }
}
