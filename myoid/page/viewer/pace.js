// How finely the body is drawn: as well as can be while it rests, coarser while it moves if frames take too long.

/** Pixels of the canvas for each of the page's, and whether there are shadows. */
const LEVELS = [
  { pixels: 2, shadows: true },
  { pixels: 1.4, shadows: true },
  { pixels: 1, shadows: true },
  { pixels: 1, shadows: false },
  { pixels: 0.7, shadows: false },
  { pixels: 0.5, shadows: false },
];
const FIRST = 3;      // level of the first picture, so that it comes soon
const LONG_MS = 20;   // of a frame; a screen shows one each 16.7 ms
const JUDGED = 6;     // frames, of which most are long, make the next ones coarser
const REST_MS = 200;  // without a new frame

export class Pace {
  /** `apply` draws at a level from now on. */
  constructor(apply) {
    this.apply = apply;
    this.moving = 0;  // level while the body moves
    this.level = -1;
    this.held = false;  // for a film, whose size must not change
    this.steps = [];
    this.#set(FIRST);
  }

  /** The body rests: the finest level. The next movement begins a level finer than the last one ended. */
  rest() {
    if (this.held) return;
    if (this.level > 0) this.moving = Math.max(0, this.moving - 1);
    this.steps = [];
    this.#set(0);
  }

  /** A frame is drawn at `now`; the one before was drawn at `last`, null if the body rested. */
  move(now, last) {
    if (this.held) return;
    if (last !== null) this.steps.push(now - last);
    if (this.steps.length === JUDGED) {
      const long = this.steps.filter((ms) => ms > LONG_MS).length;
      if (2 * long > JUDGED && this.moving + 1 < LEVELS.length) ++this.moving;
      this.steps = [];
    }
    this.#set(this.moving);
  }

  /** True when the body was last drawn so long ago that it is drawn again, finely. */
  isDue(now, last) {
    return this.level > 0 && !this.held && now - last > REST_MS;
  }

  #set(level) {
    if (level === this.level) return;
    this.level = level;
    this.apply(LEVELS[level]);
  }
}
