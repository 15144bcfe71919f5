// The clock of a trial.

export class Player {
  constructor(changed) {
    this.changed = changed;
    this.speed = 1;
    this.loop = true;
    this.playing = false;
    this.seconds = 0;
  }

  open(trial) {
    this.trial = trial;
    this.playing = false;
    this.seek(0);
  }

  get frame() {
    return this.trial.frameAt(this.seconds);
  }

  seek(seconds) {
    this.seconds = Math.min(this.trial.duration, Math.max(0, seconds));
    this.changed();
  }

  step(frames) {
    this.playing = false;
    const frame = Math.min(this.trial.frames - 1, Math.max(0, this.frame + frames));
    this.seek(this.trial.times[frame] - this.trial.times[0]);
  }

  toggle() {
    if (this.trial.frames < 2) return;
    if (!this.playing && this.seconds >= this.trial.duration) this.seconds = 0;
    this.playing = !this.playing;
    this.changed();
  }

  /** Lets real time pass. */
  advance(seconds) {
    if (!this.playing) return;
    const next = this.seconds + this.speed * seconds;
    if (next <= this.trial.duration) {
      this.seek(next);
    } else if (this.loop) {
      this.seek(next % this.trial.duration);
    } else {
      this.playing = false;
      this.seek(this.trial.duration);
    }
  }
}
