import { MISSING, STEPS, clock, codes, mesh, numbers } from './decode.js';
import { equal, near, test } from './testing.js';

const binary = (value, count) => (count ? value.toString(2).padStart(count, '0') : '');
const rice = (n, k) => `${'1'.repeat(n >> k)}0${binary(n & ((1 << k) - 1), k)}`;
const packed = (bits) => btoa(bits.match(/.{1,8}/g).map((byte) => String.fromCharCode(parseInt(byte.padEnd(8, '0'), 2))).join(''));
/** Codes without differences. */
const plain = (all, columns = 1) => packed(binary(all.length, 32) + Array.from({ length: columns }, (_, c) =>
  `00${binary(13, 4)}${all.filter((_, i) => i % columns === c).map((n) => rice(2 * n, 13)).join('')}`).join(''));

test('codes are read by their differences, column by column', () => {
  // Slopes of 3 and 3 - 1, an order of its own for each column, and one of zeros alone.
  const slope = `10${binary(1, 4)}${[20, 6, 0, 1].map((n) => rice(n, 1)).join('')}`;
  const steps = `01${binary(0, 4)}${[4, 1, 0, 3].map((n) => rice(n, 0)).join('')}`;
  const zeros = `11${binary(0, 4)}`;
  equal([...codes(packed(binary(12, 32) + slope + steps + zeros), 3)], [10, 2, 0, 13, 1, 0, 16, 1, 0, 18, 65535, 0]);
  equal([...codes(packed(`${binary(1, 32)}00${binary(0, 4)}${'1'.repeat(24)}${binary(40000, 16)}`))], [20000]);
});

test('packed numbers span lower to upper, and the last code is missing', () => {
  const { values } = numbers({ lower: -2, upper: 6, codes: plain([0, STEPS / 2, STEPS, MISSING]) });
  equal([values[0], values[1], values[2]], [-2, 2, 6]);
  equal(Number.isNaN(values[3]), true);
});

test('an even clock counts from its start', () => equal([...clock({ start: 1, step: 0.5, count: 3 })], [1, 1.5, 2]));

test('a surface is made of steps from its origin', () => {
  const { vertices, corners } = mesh({
    origin: [1, 2, 3], step: 0.001, wide: false, vertices: plain([0, 0, 0, 1000, 0, 0, 0, 500, 16000], 3), corners: plain([0, 1, 2], 3),
  });
  equal([...corners], [0, 1, 2]);
  [1, 2, 3, 2, 2, 3, 1, 2.5, 19].forEach((expected, i) => near(vertices[i], expected, 1e-5));
});
