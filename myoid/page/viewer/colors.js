// Colors of muscle values, growing brighter: told apart in grey too, and by people who see no red.

const STOPS = [
  [0.0, 0x3b, 0x5f, 0xb0],
  [0.25, 0x7a, 0x5c, 0xc0],
  [0.5, 0xc8, 0x58, 0x8f],
  [0.75, 0xf4, 0x84, 0x5a],
  [1.0, 0xff, 0xdc, 0x64],
];

export const MUSCLE = [0xc2, 0x47, 0x3f];   // without values
export const UNKNOWN = [0x84, 0x8b, 0x93];  // no value at this time

/** Red, green and blue (0..255) of a share 0..1. */
export function colorOf(share) {
  const x = Math.min(1, Math.max(0, share));
  for (let i = 1; i < STOPS.length; ++i) {
    const [to, ...upper] = STOPS[i];
    if (x > to) continue;
    const [from, ...lower] = STOPS[i - 1];
    const part = (x - from) / (to - from);
    return lower.map((c, k) => Math.round(c + part * (upper[k] - c)));
  }
  return STOPS[STOPS.length - 1].slice(1);
}

export const css = ([r, g, b]) => `rgb(${r},${g},${b})`;

/** A CSS gradient over the whole range. */
export function gradient() {
  const stops = STOPS.map(([at, ...color]) => `${css(color)} ${100 * at}%`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}
