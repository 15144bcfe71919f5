// The viewer of a moving model: reads the scene from the page and plays it.
import { Vector3 } from 'three';
import { Camera } from './camera.js';
import { Trial, mesh } from './decode.js';
import { Figure, PARTS } from './figure.js';
import { Panel, number } from './panel.js';
import { Player } from './player.js';
import { Stage } from './stage.js';

const HIDDEN_AT_FIRST = new Set(['surfaces']);

class Viewer {
  constructor({ title, subtitle, meshes, scenes }) {
    this.title = title;
    this.subtitle = subtitle;
    this.meshes = meshes.map(mesh);
    this.trials = scenes.map((scene) => new Trial(scene));
    this.visible = Object.fromEntries(PARTS.map(([part]) => [part, !HIDDEN_AT_FIRST.has(part)]));
    this.visible.ground = this.visible.axes = true;
    this.player = new Player(() => (this.dirty = true));
    this.panel = new Panel(this);
    this.canvas = this.panel.canvas;
    this.camera = new Camera(this.canvas, scenes[0].up, () => (this.dirty = true));
    this.last = new Vector3();
    this.hovered = -1;
    this.size = size(this.trials[0], this.meshes);
    this.stage = new Stage(this.canvas, this.camera.axes, this.size);
    this.openTrial(0);
    this.#resize();
    this.fit();
    this.#listen();
  }

  openTrial(index) {
    this.trial = this.trials[index];
    if (this.figure) {
      this.stage.scene.remove(this.figure.root);
      this.figure.dispose();
    }
    this.figure = new Figure(this.trial, this.meshes, this.size);
    this.stage.scene.add(this.figure.root);
    const parts = PARTS.filter(([part]) => this.figure.has(part)).map(([part, label]) => [part, label, this.visible[part]]);
    parts.push(['ground', 'Ground', this.visible.ground], ['axes', 'Axes', this.visible.axes]);
    this.panel.openTrial(this.trial, index, parts);
    this.player.open(this.trial);
    this.#survey();
    for (const part of Object.keys(this.visible)) this.show(part, this.visible[part]);
    this.paintBy(0);
  }

  /** Where the model goes in this trial, for the ground and for following it. */
  #survey() {
    const { up } = this.camera.axes;
    const few = Math.min(this.trial.frames, 25);
    let lowest = Infinity;
    const first = new Vector3();
    const middle = new Vector3();
    let travel = 0;
    const here = new Vector3();
    for (let i = 0; i < few; ++i) {
      this.figure.pose(Math.round((i * (this.trial.frames - 1)) / Math.max(1, few - 1)));
      this.figure.points((p) => (lowest = Math.min(lowest, p.dot(up))));
      this.figure.center(here);
      if (i === 0) first.copy(here);
      middle.addScaledVector(here, 1 / few);
      travel = Math.max(travel, here.distanceTo(first));
    }
    // A person stands on the ground of the laboratory; an arm that hangs below its origin does not.
    const height = lowest > -0.06 * this.size && lowest < this.size ? 0 : lowest - 0.04 * this.size;
    this.stage.ground.remove(...this.stage.ground.children);
    this.stage.layGround(height, middle, 1.3 * this.size + travel);
    this.follow = travel > 0.4 * this.size;
    this.panel.follow.input.checked = this.follow;
    this.figure.pose(this.player.frame);
    this.figure.center(this.last);
  }

  paintBy(index) {
    this.values = this.trial.values[index] || null;
    this.panel.showLegend(this.values);
    this.dirty = true;
  }

  show(part, on) {
    this.visible[part] = on;
    if (part === 'ground') this.stage.ground.visible = on;
    else if (part === 'axes') this.stage.origin.visible = on;
    else this.figure.show(part, on);
    this.dirty = true;
  }

  showMuscle(index, on) {
    this.figure.showMuscle(index, on);
    this.dirty = true;
  }

  highlight(muscle) {
    this.figure.highlight(muscle);
    this.dirty = true;
  }

  view(name) {
    this.camera.view(name);
  }

  fit() {
    this.figure.pose(this.player.frame);
    const { center, radius } = ball(this.figure);
    this.camera.fit(center, radius);
  }

  seek(seconds) {
    this.player.seek(seconds);
    this.draw();
  }

  /** Draws the frame of the player's time. */
  draw() {
    this.dirty = false;
    this.figure.pose(this.player.frame);
    this.figure.paint(this.values);
    const center = this.figure.center(new Vector3());
    if (this.follow) this.camera.shift(new Vector3().subVectors(center, this.last));
    this.last.copy(center);
    this.panel.update(this.figure, this.values);
    this.stage.draw(this.camera);
    this.dirty = false;
    Object.assign(document.body.dataset, { frame: this.figure.frame, time: this.trial.times[this.figure.frame] });
  }

  run() {
    let last = performance.now();
    const tick = (now) => {
      this.player.advance(Math.min(0.25, (now - last) / 1000));
      last = now;
      if (this.dirty) this.draw();
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  #resize() {
    const { clientWidth, clientHeight } = this.panel.stage;
    this.stage.resize(Math.max(1, clientWidth), Math.max(1, clientHeight));
    this.camera.resize(Math.max(1, clientWidth), Math.max(1, clientHeight));
    this.draw();  // at once: a canvas of a new size is empty
  }

  #listen() {
    new ResizeObserver(() => this.#resize()).observe(this.panel.stage);
    this.canvas.addEventListener('pointermove', (event) => this.#hover(event));
    this.canvas.addEventListener('pointerleave', () => this.#point(null));
    window.addEventListener('keydown', (event) => this.#key(event));
  }

  #hover(event) {
    if (event.buttons) return this.#point(null);
    const { width, height } = this.canvas.getBoundingClientRect();
    const v = new Vector3();
    const project = (point) => {
      v.copy(point).project(this.camera.camera);
      return [((v.x + 1) * width) / 2, ((1 - v.y) * height) / 2, v.z];
    };
    const found = this.figure.pick(event.offsetX, event.offsetY, project);
    this.#point(found);
    this.panel.showTip(found ? this.describe(found) : '', event.offsetX, event.offsetY);
  }

  #point(found) {
    const muscle = found && found.kind === 'muscle' ? found.index : -1;
    if (!found) this.panel.showTip('');
    if (muscle === this.hovered) return;
    this.hovered = muscle;
    this.highlight(muscle);
  }

  describe({ kind, index }) {
    const { figure, trial } = this;
    const { model } = trial;
    if (kind === 'body') return `${model.bodies[index].name}, ${number(model.bodies[index].mass)} kg`;
    if (kind === 'marker') return `${model.markers[index].name} (model)`;
    if (kind === 'measured') {
      const error = figure.markerError(index);
      const name = `${trial.measured.names[index]} (measured)`;
      return error === null ? name : `${name}, ${(1000 * error).toFixed(1)} mm from the model`;
    }
    const values = trial.values
      .map((v) => `${v.name} ${number(trial.value(v, figure.frame, index))} ${v.unit}`.trim());
    return [model.muscles[index].name, ...values].join(', ');
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const tag = event.target.tagName;
    const typing = tag === 'SELECT' || (tag === 'INPUT' && event.target.type === 'search');
    if (typing || (this.panel.help.open && event.key !== '?')) return;
    const sliding = tag === 'INPUT' && event.target.type === 'range';
    const part = PARTS.find(([, , key]) => key === event.key.toLowerCase());
    const turn = 0.1;
    const arrow = (x, y) => (event.shiftKey ? this.camera.pan(-0.05 * x, -0.05 * y) : this.camera.turn(turn * x, turn * y));
    const actions = {
      ' ': () => (tag === 'BUTTON' || event.target.type === 'checkbox' ? null : this.player.toggle()),
      ',': () => this.player.step(-1),
      '.': () => this.player.step(1),
      Home: () => this.player.step(-Infinity),
      End: () => this.player.step(Infinity),
      1: () => this.view('front'),
      2: () => this.view('side'),
      3: () => this.view('top'),
      0: () => this.view('oblique'),
      '+': () => this.camera.zoom(0.9),
      '=': () => this.camera.zoom(0.9),
      '-': () => this.camera.zoom(1.1),
      f: () => this.fit(),
      '?': () => this.panel.toggleHelp(),
      ArrowLeft: () => sliding || arrow(-1, 0),
      ArrowRight: () => sliding || arrow(1, 0),
      ArrowUp: () => sliding || arrow(0, 1),
      ArrowDown: () => sliding || arrow(0, -1),
    };
    let done = true;
    if (actions[event.key]) done = actions[event.key]();
    else if (part && this.panel.boxes[part[0]]) this.panel.boxes[part[0]].click();
    else return;
    if (done !== null && done !== true) event.preventDefault();
  }
}

/** A ball about everything that the figure shows. */
function ball(figure) {
  const lower = new Vector3(Infinity, Infinity, Infinity);
  const upper = new Vector3(-Infinity, -Infinity, -Infinity);
  figure.points((p) => {
    lower.min(p);
    upper.max(p);
  });
  if (lower.x > upper.x) return { center: new Vector3(), radius: 0.5 };
  return { center: lower.clone().add(upper).multiplyScalar(0.5), radius: Math.max(1e-3, lower.distanceTo(upper) / 2) };
}

/** How large the model is in its first posture [m]. */
function size(trial, meshes) {
  const probe = new Figure(trial, meshes, 1);
  probe.pose(0);
  const { radius } = ball(probe);
  probe.dispose();
  return 2 * radius;
}

/** What the address asks for: #t=0.3&view=side&trial=2&show=surfaces&play */
function follow(viewer, wishes) {
  if (wishes.has('trial')) viewer.openTrial(Math.max(0, Math.min(viewer.trials.length, Number(wishes.get('trial'))) - 1));
  if (wishes.has('view')) viewer.view(wishes.get('view'));
  for (const part of (wishes.get('show') || '').split(',')) if (viewer.panel.boxes[part]) viewer.panel.boxes[part].click();
  if (wishes.has('t')) viewer.seek(Number(wishes.get('t')) - viewer.trial.times[0]);
  viewer.fit();
  if (wishes.has('play')) viewer.player.toggle();
}

function start() {
  const page = JSON.parse(document.getElementById('scene').textContent);
  let viewer = null;
  try {
    viewer = new Viewer(page);
  } catch (error) {
    document.body.dataset.state = 'failed';
    const text = document.createElement('p');
    text.className = 'failure';
    text.textContent = `The model cannot be drawn: ${error.message}. This page needs WebGL; in some browsers it must be switched on.`;
    document.body.append(text);
    return;
  }
  follow(viewer, new URLSearchParams(location.hash.slice(1)));
  viewer.draw();
  viewer.run();
  window.myoid = viewer;
  Object.assign(document.body.dataset, {
    state: 'ready',
    bodies: viewer.trial.model.bodies.length,
    muscles: viewer.trial.model.muscles.length,
    frames: viewer.trial.frames,
  });
}

start();
