// A film of the trial beside the model: the study's, or a file that the reader chooses. Nothing is sent anywhere.
import { el } from './element.js';

const address = (path) => path.split('/').map(encodeURIComponent).join('/');

export class Video {
  constructor(changed) {
    this.chosen = new Map();  // trial: address of the file that the reader chose
    this.offsets = new Map();
    this.film = el('video', { muted: true, hidden: true, playsInline: true, preload: 'auto', attributes: { 'aria-label': 'Film of the trial' } });
    this.film.addEventListener('error', () => this.#missing());
    this.film.addEventListener('loadeddata', () => {
      this.film.hidden = false;
      this.says.hidden = true;
      changed();
    });
    this.says = el('p', { className: 'no-film', hidden: true });
    this.offset = el('input', { type: 'number', step: 0.01, title: 'Time of the trial at which the film begins [s]; to keep it, write it into study.toml as video_offset_s' });
    this.offset.addEventListener('input', () => {
      this.offsets.set(this.trial, Number(this.offset.value));
      changed();
    });
    this.begins = el('label', { hidden: true }, 'begins at ', this.offset, ' s');
    this.file = el('input', { type: 'file', accept: 'video/*' });
    this.file.addEventListener('change', () => {
      if (!this.file.files[0]) return;
      this.chosen.set(this.trial, URL.createObjectURL(this.file.files[0]));
      this.file.value = '';
      this.open(this.trial);
    });
    this.element = el('span', { className: 'video' }, el('label', { className: 'file', title: 'Show a film of the recording beside the model' }, 'Video…', this.file), this.begins);
    this.screen = el('div', { className: 'screen' }, this.film, this.says);
  }

  /** Shows the film of a trial, if it has one. */
  open(trial) {
    this.trial = trial;
    const { video } = trial.data;
    const source = this.chosen.get(trial) || (video && address(video.file));
    this.film.hidden = this.says.hidden = true;
    this.begins.hidden = !source;
    this.offset.value = this.offsets.get(trial) ?? (video ? video.offset : 0);
    this.film.pause();
    if (source) this.film.src = source;
    else this.film.removeAttribute('src');
  }

  #missing() {
    if (!this.film.getAttribute('src')) return;
    const name = this.chosen.has(this.trial) ? 'The chosen file' : this.trial.data.video.file;
    this.film.hidden = true;
    this.says.hidden = false;
    this.says.textContent = `${name} cannot be played: it is missing, or of a format that this browser lacks. Video… opens another file.`;
  }

  /** Brings the film to a time of the trial. */
  show(time, playing, speed) {
    if (this.film.hidden) return;
    const t = time - Number(this.offset.value);
    const end = this.film.duration || Infinity;
    const inside = t >= 0 && t <= end;
    this.film.classList.toggle('outside', !inside);
    const runs = playing && inside;
    const at = Math.max(0, Math.min(end, t));
    if (Math.abs(this.film.currentTime - at) > (runs ? 0.15 : 0.005)) this.film.currentTime = at;
    if (runs !== this.film.paused) return;
    this.film.playbackRate = speed;
    if (runs) this.film.play().catch(() => {});
    else this.film.pause();
  }
}
