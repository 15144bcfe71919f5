// The moving model in a canvas, without anything beside it: one Replay for a page of its own (main.js) and for the
// workbench (workbench.js).
import { Vector3 } from 'three';
import { Camera } from './camera.js';
import { Trial, mesh } from './decode.js';
import { Figure, PARTS } from './figure.js';
import { Pace } from './pace.js';
import { Stage } from './stage.js';

const HIDDEN_AT_FIRST = new Set(['surfaces']);

export class Replay {
  constructor({ meshes, models, scenes }) {
    this.meshes = meshes.map(mesh);
    this.scenes = scenes;
    this.models = models;
    this.trials = [];
    this.up = models[scenes[0].model].up;
    this.visible = Object.fromEntries(PARTS.map(([part]) => [part, !HIDDEN_AT_FIRST.has(part)]));
    this.visible.ground = this.visible.axes = true;
    this.frame = 0;
    this.drawnAt = this.ticked = -1;  // [ms]
    this.last = new Vector3();
    this.hovered = -1;
  }

  /** A trial, unpacked when it is needed first. */
  trialAt(index) {
    return (this.trials[index] ||= new Trial(this.scenes[index], this.models));
  }

  /** Starts to draw the trial `index` into `canvas`, as large as the element `frame`. */
  mount(canvas, frame, index = 0) {
    this.canvas = canvas;
    this.element = frame;
    this.camera = new Camera(canvas, this.up, () => (this.dirty = true));
    this.size = size(this.trialAt(0), this.meshes);
    this.stage = new Stage(canvas, this.camera.axes, this.size);
    this.pace = new Pace((level) => this.stage.setLevel(level));
    this.openTrial(index);
    this.#resize();
    this.fit();
    new ResizeObserver(() => this.#resize()).observe(frame);
    canvas.addEventListener('pointermove', (event) => this.#hover(event));
    canvas.addEventListener('pointerleave', () => this.#point(null));
  }

  // A page that shows more than the canvas overrides these.
  opened() {}
  drawn() {}
  showTip() {}

  openTrial(index) {
    if (this.trial === this.trialAt(index)) return;
    this.trial = this.trialAt(index);
    if (this.figure) {
      this.stage.scene.remove(this.figure.root);
      this.figure.dispose();
    }
    this.figure = new Figure(this.trial, this.meshes, this.size);
    this.stage.scene.add(this.figure.root);
    const parts = PARTS.filter(([part]) => this.figure.has(part)).map(([part, label]) => [part, label, this.visible[part]]);
    parts.push(['ground', 'Ground', this.visible.ground], ['axes', 'Axes', this.visible.axes]);
    this.frame = 0;
    this.opened(index, parts);
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
    this.figure.pose(this.frame);
    this.figure.center(this.last);
  }

  paintBy(index) {
    this.values = this.trial.values[index] || null;
    this.dirty = true;
  }

  /** Chooses the frame that is drawn next. */
  showFrame(frame) {
    if (frame !== this.frame) this.dirty = true;
    this.frame = frame;
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
    this.figure.pose(this.frame);
    const { center, radius } = ball(this.figure);
    this.camera.fit(center, radius);
  }

  /** At each frame of the screen: draws what changed, finely once it rests. */
  tick(now) {
    if (this.dirty) {
      this.pace.move(now, this.drawnAt === this.ticked ? this.ticked : null);
      this.draw();
      this.drawnAt = now;
    } else if (this.pace.isDue(now, this.drawnAt)) {
      this.pace.rest();
      this.draw();
    }
    this.ticked = now;
  }

  /** Draws the current frame. */
  draw() {
    this.dirty = false;
    this.figure.pose(this.frame);
    this.figure.paint(this.values);
    const center = this.figure.center(new Vector3());
    if (this.follow) this.camera.shift(new Vector3().subVectors(center, this.last));
    this.last.copy(center);
    this.drawn();
    this.stage.draw(this.camera);
    this.dirty = false;
    Object.assign(document.body.dataset, { frame: this.figure.frame, time: this.trial.times[this.figure.frame] });
  }

  #resize() {
    const shape = [this.element.clientWidth, this.element.clientHeight].map((length) => Math.max(1, length));
    if (String(shape) === String(this.shape)) return;
    this.stage.resize(...shape);
    this.camera.resize(...shape);
    if (this.shape) this.draw();  // at once: a canvas of a new size is empty
    this.dirty = true;
    this.shape = shape;
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
    this.showTip(found ? this.describe(found) : '', event.offsetX, event.offsetY);
  }

  #point(found) {
    const muscle = found && found.kind === 'muscle' ? found.index : -1;
    if (!found) this.showTip('');
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

  /** Turns and moves the view with the arrow keys; true if the key was one of the view's. */
  viewKey(event) {
    const arrow = (x, y) => (event.shiftKey ? this.camera.pan(-0.05 * x, -0.05 * y) : this.camera.turn(0.1 * x, 0.1 * y));
    const actions = {
      1: () => this.view('front'),
      2: () => this.view('side'),
      3: () => this.view('top'),
      0: () => this.view('oblique'),
      '+': () => this.camera.zoom(0.9),
      '=': () => this.camera.zoom(0.9),
      '-': () => this.camera.zoom(1.1),
      f: () => this.fit(),
      ArrowLeft: () => arrow(-1, 0),
      ArrowRight: () => arrow(1, 0),
      ArrowUp: () => arrow(0, 1),
      ArrowDown: () => arrow(0, -1),
    };
    if (!actions[event.key]) return false;
    actions[event.key]();
    return true;
  }
}

/** Four significant digits, short. */
export function number(value) {
  if (value === null || Number.isNaN(value)) return '–';
  const size = Math.abs(value);
  return value.toFixed(size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : 3);
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
