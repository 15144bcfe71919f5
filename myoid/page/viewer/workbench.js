// The workbench of a report: body, EMG, torque, muscles and channels of a trial on one time cursor.
import { Carpet } from './carpet.js';
import { gradient } from './colors.js';
import { el, select } from './element.js';
import { tension } from './law.js';
import { Learn } from './learn.js';
import { upgradeFigures } from './figures.js';
import { Plot } from './plot.js';
import { band, repetitions } from './repetitions.js';
import { Replay } from './replay.js';
import { save } from './save.js';
import { foldSections, unfold } from './sections.js';
import { nearest, text } from './series.js';
import { KEYS } from './texts.js';
import { TrialValues } from './trial_values.js';
import { Video } from './video.js';

const SPEEDS = [0.1, 0.25, 0.5, 1, 2];
const GROUPS = [['angle', 'Angles'], ['torque', 'Torques'], ['load', 'Loads'], ['emg', 'EMG'], ['activation', 'Activation'], ['force', 'Forces'], ['carpet', 'Channels']];
const MOST_AT_FIRST = 8;  // plots of one group
const SIGNS = { good: '●', weak: '◆', bad: '▲', info: '□', none: '○' };

const sentence = (says) => says.charAt(0).toUpperCase() + says.slice(1) + (/[.!?]$/.test(says) ? '' : '.');

export class Workbench {
  constructor(data, scenes) {
    this.element = document.getElementById('workbench');
    this.data = data;
    this.trials = data.trials.map((t) => new TrialValues(t));
    this.hidden = new Set();
    this.chosen = {};  // group: titles that are shown; absent: the first few
    this.playing = false;
    this.speed = 1;
    this.compared = -1;
    this.on = {
      hover: (t) => this.point(t),
      pick: (t) => this.seek(t),
      zoom: (a, b) => this.zoom([a, b]),
      reset: () => this.zoom(null),
    };
    this.#build(scenes);
    this.learn = data.muscles.length && data.trials.some((t) => t.drives.length) ? new Learn(this) : null;
    if (this.learn) this.element.append(this.learn.element);
    foldSections();
    upgradeFigures(data.figures);
    const first = this.#firstTrial();
    this.#replay(scenes, Math.max(0, this.trials[first].scene));
    this.#listen();
    this.open(first);
    this.#follow();
    this.#run();
  }

  /** The trial with the most to see: a movement of the fit. */
  #firstTrial() {
    const moves = (t) => t.data.plots.filter((p) => p.kind === 'angle').reduce((most, p) => Math.max(most, p.lines[0].value.upper - p.lines[0].value.lower), 0);
    const worth = (t) => (t.scene >= 0 ? 2000 : 0) + (t.data.drives.length ? 4000 : 0) + moves(t);
    return this.trials.reduce((best, t, i) => (worth(t) > worth(this.trials[best]) ? i : best), 0);
  }

  #build(scenes) {
    const button = (label, title, action) => el('button', { type: 'button', textContent: label, title, onclick: action });
    this.chips = this.trials.map((t, i) => {
      const title = [t.use, ...t.remarks, ...t.marks.map((m) => m.text)].join('\n');
      return el('button', { type: 'button', className: `chip ${t.badge}`, title, onclick: () => this.open(i) },
        el('i', { textContent: SIGNS[t.badge], attributes: { 'aria-hidden': 'true' } }), ` ${t.name}`);
    });
    this.remarks = el('p', { className: 'remarks', attributes: { 'aria-live': 'polite' } });
    this.compare = select('Compare with', ['no other trial', 'its repetitions', ...this.trials.map((t) => t.name)], (i) => {
      this.#setBeside(i);
      this.#plots();
      this.#remember();
    });
    const groups = GROUPS.filter(([kind]) => kind === 'carpet' || this.trials.some((t) => t.data.plots.some((p) => p.kind === kind)));
    this.boxes = Object.fromEntries(groups.map(([kind, label]) => {
      const input = el('input', { type: 'checkbox', checked: true });
      input.addEventListener('change', () => {
        if (input.checked) this.hidden.delete(kind);
        else this.hidden.add(kind);
        this.#plots();
        this.#remember();
      });
      return [kind, el('label', { className: 'check' }, input, label)];
    }));
    this.canvas = el('canvas', { tabIndex: 0, attributes: { 'aria-label': 'The model; drag to turn it' } });
    this.tip = el('div', { className: 'tip', hidden: true });
    this.legend = el('div', { className: 'colors', hidden: true });
    this.still = el('p', { className: 'still', hidden: true, textContent: 'No motion was computed for this trial.' });
    const views = ['front', 'side', 'top', 'oblique'].map((name) => button(name, `Look from: ${name}`, () => {
      this.look = name;
      this.replay.view(name);
      this.#remember();
    }));
    this.stage = el('div', { className: 'stage' }, this.canvas, this.still, this.tip,
      el('div', { className: 'views' }, ...views, button('fit', 'All in view (F)', () => this.replay.fit())), this.legend);
    this.play = button('►', 'Play or pause (Space)', () => this.toggle());
    this.play.className = 'play';
    this.scrub = el('input', { type: 'range', min: 0, max: 1, step: 'any', attributes: { 'aria-label': 'Time' } });
    this.scrub.addEventListener('input', () => this.seek(Number(this.scrub.value)));
    this.time = el('output', { className: 'time' });
    const speed = select('Speed', SPEEDS.map((s) => `${s} ×`), (i) => (this.speed = SPEEDS[i]));
    speed.value = SPEEDS.indexOf(1);
    this.filming = button('Film', 'Save the body as a film (WebM), as fast as it is played', () => this.film());
    this.color = el('span');
    this.video = new Video(() => this.#sync());
    this.parts = el('details', { className: 'parts' });
    this.side = el('div', { className: 'left' }, this.stage, this.video.screen,
      el('div', { className: 'row' }, this.play, this.scrub), el('div', { className: 'row' }, this.time, speed, this.color),
      el('div', { className: 'row small' }, button('Picture', 'Save the body as a PNG picture', () => this.picture()),
        this.filming, this.video.element, this.parts));
    this.grid = el('div', { className: 'plots' });
    this.carpet = new Carpet(this.on);
    this.choice = el('details', { className: 'choice' });
    const help = el('details', { className: 'keys' }, el('summary', { textContent: 'Keys and mouse' }),
      el('p', { textContent: 'Point at a plot to read its values, click to move the body there, drag to zoom, double click for the whole trial. The address of the page holds what is shown.' }),
      el('table', {}, ...KEYS.map(([key, what]) => el('tr', {}, el('th', { textContent: key }), el('td', { textContent: what })))));
    this.element.append(
      el('h2', { textContent: 'Workbench' }),
      el('div', { className: 'chips', attributes: { role: 'group', 'aria-label': 'Trial' } }, ...this.chips), this.remarks,
      el('div', { className: 'row options' }, ...Object.values(this.boxes), el('label', { className: 'check' }, 'beside: ', this.compare),
        button('whole trial', 'Show the whole trial (Esc)', () => this.zoom(null)), this.choice, help),
      el('div', { className: 'bench' }, this.side, el('div', { className: 'right' }, this.grid, this.carpet.element)));
    if (!scenes) this.side.classList.add('without-scene');
    this.element.hidden = false;
    for (const link of document.querySelectorAll('.live-only')) link.hidden = false;
    document.body.classList.add('live');
  }

  #sync() {
    this.video.show(this.t, this.playing, this.speed);
  }

  #replay(scenes, first) {
    this.replay = null;
    if (!scenes || !scenes.scenes.length) return;
    try {
      const replay = new Replay(scenes);
      replay.showTip = (says, x, y) => {
        this.tip.hidden = !says;
        this.tip.textContent = says;
        this.tip.style.transform = `translate(${(x || 0) + 12}px, ${(y || 0) + 8}px)`;
      };
      replay.opened = (index, parts) => this.parts.replaceChildren(el('summary', { textContent: 'Parts of the body' }), ...parts.map(([part, label, on]) => {
        const input = el('input', { type: 'checkbox', checked: on });
        input.addEventListener('change', () => replay.show(part, input.checked));
        return el('label', { className: 'check' }, input, label);
      }));
      replay.mount(this.canvas, this.stage, first);
      this.replay = replay;
    } catch (error) {
      this.still.hidden = false;
      this.still.textContent = `The model cannot be drawn: ${error.message}. It needs WebGL; in some browsers it must be switched on.`;
      this.canvas.hidden = true;
    }
  }

  get trial() {
    return this.trials[this.index];
  }

  /** The clock whose samples the cursor stands on. */
  get steps() {
    const plot = this.trial.plots.find((p) => p.kind === 'torque') || this.trial.plots.find((p) => p.kind === 'angle') || this.trial.plots[0];
    return plot ? plot.curves[0].x : Float64Array.of(...this.trial.extent);
  }

  open(index) {
    this.index = index;
    this.chips.forEach((chip, i) => chip.setAttribute('aria-pressed', i === index));
    const { trial } = this;
    this.domain = trial.extent;
    this.view = null;
    if (this.playing) this.toggle();
    const facts = [...trial.remarks, ...trial.marks.map((m) => m.text)];
    this.remarks.replaceChildren(el('b', { textContent: `${trial.name} (${trial.use})` }), facts.length ? ` ${facts.slice(0, 6).map(sentence).join(' ')}` : ' Nothing was found against this trial.');
    [this.scrub.min, this.scrub.max] = this.domain;
    if (this.replay && trial.scene >= 0) {
      this.replay.openTrial(trial.scene);
      this.replay.fit();
      this.#colors();
    }
    this.canvas.hidden = !this.replay || trial.scene < 0;
    if (this.replay) this.still.hidden = trial.scene >= 0;
    this.video.open(trial);
    this.carpet.domain = this.domain;
    this.carpet.view = null;
    this.carpet.open(trial);
    this.#plots();
    if (this.learn) this.learn.openTrial();
    this.seek(this.domain[0]);
  }

  #colors() {
    const values = this.replay.trial.values;
    const shown = select('Muscle color', [...values.map((v) => `color: ${v.name}`), 'one color'], (i) => this.#paint(i));
    shown.hidden = values.length === 0;
    this.color.replaceChildren(shown);
    this.#paint(0);
  }

  #paint(i) {
    this.replay.paintBy(i);
    const { values } = this.replay;
    this.legend.hidden = !values;
    if (!values) return;
    const bar = el('i');
    bar.style.background = gradient();
    this.legend.replaceChildren(`${values.name}: 0 `, bar, ` ${text(values.top, values.top < 10 ? 1 : 0)} ${values.unit}`);
  }

  /** Chooses the curves beside the trial's: 0 none, 1 its repetitions, then the trials. */
  #setBeside(choice) {
    this.repeated = choice === 1;
    this.compared = choice - 2;
    this.compare.value = Math.max(0, choice);
  }

  /** The curve of a plot that stands for a trial beside others. */
  #mainCurve(trial, plot) {
    const same = trial.plots.find((o) => o.kind === plot.kind && o.title === plot.title);
    return same && same.kind !== 'activation' ? same.curves.find((q) => !q.upper) : undefined;
  }

  /** Grey curves behind the trial's: another trial from its own begin, or the band of the repetitions. */
  #beside(plot) {
    const other = this.trials[this.compared];
    const c = other && this.#mainCurve(other, plot);
    if (c) return [{ ...c, name: other.name, role: 'other', own: true, x: c.x.map((x) => x + this.domain[0] - other.extent[0]) }];
    if (!this.repeated) return [];
    const parts = repetitions(this.trials, this.trial).flatMap((t) => {
      const curve = this.#mainCurve(t, plot);
      return curve ? [{ curve, extent: t.extent }] : [];
    });
    const found = band(parts, this.domain);
    return found ? [found] : [];
  }

  /** Makes the plots of the trial. */
  #plots() {
    const option = this.compare.querySelectorAll('option')[1];
    option.disabled = repetitions(this.trials, this.trial).length === 0;
    const shown = this.trial.plots.filter((p) => !this.hidden.has(p.kind) && this.#isChosen(p));
    this.plots = shown.map((p) => {
      const curves = [...this.#beside(p), ...p.curves];
      const marks = this.trial.marks.filter((m) => m.begin !== null && m.about.split(', ').includes(p.title)).map((m) => ({ from: m.begin, to: m.end, text: m.text }));
      const plot = new Plot({ ...p, curves, marks, prefix: this.trial.name, height: p.kind === 'torque' ? 168 : p.kind === 'angle' ? 168 : 118 }, this.on);
      plot.domain = this.domain;
      plot.view = this.view;
      if (p.kind === 'force') this.#linkMuscle(plot);
      return plot;
    });
    this.grid.replaceChildren(...this.plots.map((p) => p.element));
    this.carpet.element.hidden = this.hidden.has('carpet') || this.trial.carpet.rows.length === 0;
    this.#choices();
    this.#resize();
    for (const plot of this.plots) plot.setCursor(this.t);
  }

  /** Pointing at a muscle's force lights the muscle up in the body. */
  #linkMuscle(plot) {
    const index = () => (this.replay ? this.replay.trial.model.muscles.findIndex((m) => m.name === plot.title) : -1);
    plot.element.addEventListener('pointerenter', () => this.replay?.highlight(index()));
    plot.element.addEventListener('pointerleave', () => this.replay?.highlight(-1));
  }

  #isChosen(plot) {
    const all = this.trial.plots.filter((p) => p.kind === plot.kind);
    const wanted = this.chosen[plot.kind];
    return wanted ? wanted.has(plot.title) : all.indexOf(plot) < MOST_AT_FIRST;
  }

  /** Which plots of a large group are shown. */
  #choices() {
    const large = GROUPS.map(([kind, label]) => [kind, label, this.trial.plots.filter((p) => p.kind === kind)]).filter(([, , all]) => all.length > MOST_AT_FIRST);
    this.choice.hidden = large.length === 0;
    const open = this.choice.open;
    this.choice.replaceChildren(el('summary', { textContent: 'Which plots' }), ...large.map(([kind, label, all]) =>
      el('div', { className: 'many' }, el('b', { textContent: `${label}: ` }), ...all.map((p) => {
        const input = el('input', { type: 'checkbox', checked: this.#isChosen(p) });
        input.addEventListener('change', () => {
          this.chosen[kind] ||= new Set(all.slice(0, MOST_AT_FIRST).map((q) => q.title));
          if (input.checked) this.chosen[kind].add(p.title);
          else this.chosen[kind].delete(p.title);
          this.#plots();
        });
        return el('label', { className: 'check' }, input, p.title);
      }))));
    this.choice.open = open;
  }

  #resize() {
    // All widths first: each question after a drawing would lay out the page again.
    const parts = [...this.plots, this.carpet];
    const widths = parts.map((part) => part.element.clientWidth);
    parts.forEach((part, i) => part.resize(widths[i]));
    if (this.learn) this.learn.resize();
  }

  /** Moves body and cursor to the time. */
  seek(t) {
    this.t = Math.max(this.domain[0], Math.min(this.domain[1], t));
    this.scrub.value = this.t;
    for (const plot of this.plots) plot.setCursor(this.t);
    if (this.learn) this.learn.setCursor(this.t);
    this.carpet.setCursor(this.t);
    let frame = '';
    if (this.replay && this.trial.scene >= 0) {
      const { times } = this.replay.trial;
      this.replay.showFrame(this.replay.trial.frameAt(this.t - times[0]));
      frame = ` · frame ${this.replay.frame + 1} of ${this.replay.trial.frames}`;
    }
    this.time.textContent = `${text(this.t, 3)} s${frame}`;
    this.#sync();
    if (!this.playing) this.#remember();
  }

  /** Reads the values at a time off every plot, without moving the body. */
  point(t) {
    for (const plot of this.plots) plot.setPointer(t);
    if (this.learn) this.learn.setPointer(t);
  }

  zoom(view) {
    if (view && view[1] - view[0] < 1e-3) return;
    this.view = view ? [Math.max(this.domain[0], view[0]), Math.min(this.domain[1], view[1])] : null;
    for (const plot of this.plots) plot.setView(this.view);
    this.carpet.setView(this.view);
    if (this.learn) this.learn.setView(this.view);
    this.#remember();
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.t >= this.domain[1] - 1e-6) this.seek(this.domain[0]);
    this.play.textContent = this.playing ? '❚❚' : '►';
    this.#sync();
    if (this.playing) return;
    this.#endFilm();
    this.#remember();
  }

  step(samples) {
    if (this.playing) this.toggle();
    const { steps } = this;
    this.seek(steps[Math.max(0, Math.min(steps.length - 1, nearest(steps, this.t) + samples))]);
  }

  #run() {
    let last = performance.now();
    const tick = (now) => {
      const passed = Math.min(0.25, (now - last) / 1000);
      last = now;
      if (this.playing) {
        const [from, to] = this.view || this.domain;
        const next = this.t + this.speed * passed;
        if (next > to) this.#endFilm();
        this.seek(next > to ? from : next);
      }
      if (this.replay && !this.canvas.hidden) this.replay.tick(now);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  #listen() {
    new ResizeObserver(() => this.#resize()).observe(this.element);
    window.addEventListener('keydown', (event) => this.#key(event));
    window.addEventListener('hashchange', () => this.#follow());
    for (const link of document.querySelectorAll('header a[href^="#"], nav.contents a')) link.addEventListener('click', (event) => {
      // The address is the workbench's: sections are scrolled to.
      const target = document.getElementById(link.hash.slice(1));
      if (!target) return;
      event.preventDefault();
      unfold(target.parentElement);
      target.scrollIntoView();
    });
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tagName, type } = event.target;
    if (tagName === 'SELECT' || tagName === 'TEXTAREA' || (tagName === 'INPUT' && type !== 'checkbox')) return;
    const box = this.element.getBoundingClientRect();
    const inside = this.element.contains(document.activeElement);
    if (!inside && (box.top > 0.7 * innerHeight || box.bottom < 0.3 * innerHeight)) return;
    if (event.key === ' ' && (tagName === 'BUTTON' || tagName === 'SUMMARY' || type === 'checkbox')) return;
    const many = event.shiftKey ? 10 : 1;
    const [a, b] = this.view || this.domain;
    const about = (factor) => this.zoom([this.t - factor * (this.t - a), this.t + factor * (b - this.t)]);
    const actions = {
      ' ': () => this.toggle(),
      ',': () => this.step(-many),
      '<': () => this.step(-10),
      ';': () => this.step(-10),
      '.': () => this.step(many),
      '>': () => this.step(10),
      ':': () => this.step(10),
      Home: () => this.seek(a),
      End: () => this.seek(b),
      '[': () => this.open(Math.max(0, this.index - 1)),
      ']': () => this.open(Math.min(this.trials.length - 1, this.index + 1)),
      z: () => about(0.5),
      x: () => about(2),
      Escape: () => this.zoom(null),
    };
    const action = actions[event.key];
    if (action) action();
    else if (!this.replay || (event.key.startsWith('Arrow') && document.activeElement !== this.canvas) || !this.replay.viewKey(event)) return;
    event.preventDefault();
  }

  /** Writes what is shown into the address: #trial=slow&t=1.23&from=1&to=2&view=side&hide=emg */
  #remember() {
    if (!this.ready) return;
    clearTimeout(this.remembering);
    this.remembering = setTimeout(() => {
      const wishes = new URLSearchParams({ trial: this.trial.name, t: this.t.toFixed(3) });
      if (this.view) {
        wishes.set('from', this.view[0].toFixed(3));
        wishes.set('to', this.view[1].toFixed(3));
      }
      if (this.look) wishes.set('view', this.look);
      if (this.hidden.size) wishes.set('hide', [...this.hidden].join(','));
      if (this.compared >= 0) wishes.set('beside', this.trials[this.compared].name);
      if (this.repeated) wishes.set('repetitions', '1');
      history.replaceState(null, '', `#${wishes}`);
    }, 60);
  }

  /** Shows what the address asks for. */
  #follow() {
    const hash = location.hash.slice(1);
    if (hash.includes('=')) {
      const wishes = new URLSearchParams(hash);
      this.hidden = new Set((wishes.get('hide') || '').split(',').filter((kind) => this.boxes[kind]));
      for (const [kind, box] of Object.entries(this.boxes)) box.querySelector('input').checked = !this.hidden.has(kind);
      const beside = this.trials.findIndex((t) => t.name === wishes.get('beside'));
      this.#setBeside(beside >= 0 ? beside + 2 : wishes.has('repetitions') ? 1 : 0);
      const index = this.trials.findIndex((t) => t.name === wishes.get('trial'));
      this.open(index < 0 ? this.index : index);
      if (wishes.has('from')) this.zoom([Number(wishes.get('from')), Number(wishes.get('to') || this.domain[1])]);
      if (wishes.has('t') && Number.isFinite(Number(wishes.get('t')))) this.seek(Number(wishes.get('t')));
      if (wishes.has('view') && this.replay) this.replay.view((this.look = wishes.get('view')));
      if (!this.ready) this.element.scrollIntoView();
    }
    this.ready = true;
  }

  picture() {
    this.replay?.pace.rest();
    this.replay?.draw();
    this.canvas.toBlob((blob) => blob && save(`${this.trial.name}_${text(this.t, 3)}s.png`, blob));
  }

  /** Plays what is shown once and saves the body as a film; again, or a pause: ends the film there. */
  film() {
    if (this.recorder) return this.#endFilm();
    const kind = ['webm', 'mp4'].find((name) => window.MediaRecorder?.isTypeSupported(`video/${name}`));
    if (!this.replay || !kind) return;
    const parts = [];
    const recorder = new MediaRecorder(this.canvas.captureStream(30), { mimeType: `video/${kind}` });
    const name = `${this.trial.name}.${kind}`;
    recorder.ondataavailable = (event) => parts.push(event.data);
    recorder.onstop = () => {
      this.recorder = null;
      this.replay.pace.held = false;
      this.filming.textContent = 'Film';
      if (this.playing) this.toggle();
      save(name, new Blob(parts, { type: `video/${kind}` }));
    };
    this.recorder = recorder;
    this.replay.pace.held = true;
    this.filming.textContent = 'End film';
    this.seek((this.view || this.domain)[0]);
    if (!this.playing) this.toggle();
    recorder.start();
  }

  #endFilm() {
    if (this.recorder?.state === 'recording') this.recorder.stop();
  }
}

export function startWorkbench(data, scenes) {
  const workbench = new Workbench(data, scenes);
  window.myoid = Object.assign(workbench, { tension });
  document.body.dataset.state = 'ready';
}
