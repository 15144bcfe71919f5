// A film of the recording beside the model: chosen by the reader, never sent anywhere.
import { el } from './element.js';

export class Video {
  constructor(changed) {
    this.film = el('video', { muted: true, hidden: true, playsInline: true });
    this.offset = el('input', { type: 'number', step: 0.01, value: 0, title: 'Time of the trial at which the film begins [s]', hidden: true });
    const file = el('input', { type: 'file', accept: 'video/*' });
    file.addEventListener('change', () => {
      if (!file.files[0]) return;
      this.film.src = URL.createObjectURL(file.files[0]);
      this.film.hidden = this.offset.hidden = false;
    });
    this.offset.addEventListener('input', changed);
    this.element = el('span', {}, el('label', { className: 'file', title: 'Show a film of the recording beside the model' }, 'Video…', file), this.offset, this.film);
  }

  /** Brings the film to a time of the trial. */
  show(time, playing, speed) {
    if (this.film.hidden) return;
    const t = time - Number(this.offset.value);
    if (Math.abs(this.film.currentTime - t) > (playing ? 0.15 : 0.005)) this.film.currentTime = Math.max(0, t);
    if (playing !== this.film.paused) return;
    this.film.playbackRate = speed;
    if (playing) this.film.play().catch(() => {});
    else this.film.pause();
  }
}
