// The page that shows a moving model alone.
import { PARTS } from './figure.js';
import { Panel } from './panel.js';
import { Player } from './player.js';
import { Replay } from './replay.js';

class Viewer extends Replay {
  constructor(page) {
    super(page);
    this.title = page.title;
    this.subtitle = page.subtitle;
    this.player = new Player(() => {
      this.frame = this.player.frame;
      this.dirty = true;
    });
    this.panel = new Panel(this);
    this.mount(this.panel.canvas, this.panel.stage);
    window.addEventListener('keydown', (event) => this.#key(event));
  }

  opened(index, parts) {
    this.panel.openTrial(this.trial, index, parts);
    this.player.open(this.trial);
  }

  openTrial(index) {
    super.openTrial(index);
    this.panel.follow.input.checked = this.follow;
  }

  paintBy(index) {
    super.paintBy(index);
    this.panel.showLegend(this.values);
  }

  drawn() {
    this.panel.update(this.figure, this.values);
  }

  showTip(text, x, y) {
    this.panel.showTip(text, x, y);
  }

  seek(seconds) {
    this.player.seek(seconds);
    this.draw();
  }

  run() {
    let last = performance.now();
    const tick = (now) => {
      this.player.advance(Math.min(0.25, (now - last) / 1000));
      last = now;
      this.tick(now);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const tag = event.target.tagName;
    const typing = tag === 'SELECT' || (tag === 'INPUT' && event.target.type === 'search');
    if (typing || (this.panel.help.open && event.key !== '?')) return;
    const sliding = tag === 'INPUT' && event.target.type === 'range';
    const part = PARTS.find(([, , key]) => key === event.key.toLowerCase());
    const actions = {
      ' ': () => (tag === 'BUTTON' || event.target.type === 'checkbox' ? null : this.player.toggle()),
      ',': () => this.player.step(-1),
      '.': () => this.player.step(1),
      Home: () => this.player.step(-Infinity),
      End: () => this.player.step(Infinity),
      '?': () => this.panel.toggleHelp(),
    };
    if (actions[event.key]) {
      if (actions[event.key]() === null) return;
    } else if (part && this.panel.boxes[part[0]]) {
      this.panel.boxes[part[0]].click();
    } else if ((sliding && event.key.startsWith('Arrow')) || !this.viewKey(event)) {
      return;
    }
    event.preventDefault();
  }
}

/** What the address asks for: #t=0.3&view=side&trial=2&show=surfaces&play */
function follow(viewer, wishes) {
  if (wishes.has('trial')) viewer.openTrial(Math.max(0, Math.min(viewer.scenes.length, Number(wishes.get('trial'))) - 1));
  if (wishes.has('view')) viewer.view(wishes.get('view'));
  for (const part of (wishes.get('show') || '').split(',')) if (viewer.panel.boxes[part]) viewer.panel.boxes[part].click();
  if (wishes.has('t')) viewer.seek(Number(wishes.get('t')) - viewer.trial.times[0]);
  viewer.fit();
  if (wishes.has('play')) viewer.player.toggle();
}

export function startViewer(page) {
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
