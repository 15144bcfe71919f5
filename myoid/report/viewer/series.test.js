import { clock, decimals, nearest, numbers, text, ticks } from './series.js';
import { equal, near, test } from './testing.js';

/** 16-bit codes as the page has them. */
const packed = (codes) => btoa(String.fromCharCode(...codes.flatMap((c) => [c & 255, c >> 8])));

test('packed numbers span lower to upper, and the last code is missing', () => {
  const { values } = numbers({ lower: -2, upper: 6, codes: packed([0, 32767, 65534, 65535]) });
  equal([values[0], values[1], values[2]], [-2, 2, 6]);
  equal(Number.isNaN(values[3]), true);
});

test('an even clock counts from its start', () => equal([...clock({ start: 1, step: 0.5, count: 3 })], [1, 1.5, 2]));

test('the nearest value', () => equal([-1, 0.4, 0.6, 2.4, 9].map((at) => nearest([0, 1, 2, 3], at)), [0, 0, 1, 2, 3]));

test('digits are those that the packing keeps', () => {
  equal([0.02, 0.002, 1e-9, 3].map(decimals), [0, 1, 4, 0]);
  equal([text(-0.004, 2), text(-1.5, 1), text(NaN, 1)], ['0.00', '−1.5', '–']);
});

test('ticks are round and cover the range', () => {
  equal(ticks(-0.1, 1.05, 5).map((t) => t.label), ['0.0', '0.5', '1.0']);
  equal(ticks(0, 130, 6).map((t) => t.at), [0, 50, 100]);
  near(ticks(0, 0.0031, 3)[1].at, 0.002, 1e-12);
});
