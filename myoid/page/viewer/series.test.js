import { decimals, nearest, text, ticks } from './series.js';
import { equal, near, test } from './testing.js';

test('the nearest value', () => equal([-1, 0.4, 0.6, 2.4, 9].map((at) => nearest([0, 1, 2, 3], at)), [0, 0, 1, 2, 3]));

test('digits are those that the packing keeps', () => {
  equal([0.02, 0.004, 1e-9, 3].map(decimals), [1, 2, 4, 0]);
  equal([text(-0.004, 2), text(-1.5, 1), text(NaN, 1)], ['0.00', '−1.5', '–']);
});

test('ticks are round and cover the range', () => {
  equal(ticks(-0.1, 1.05, 5).map((t) => t.label), ['0.0', '0.5', '1.0']);
  equal(ticks(0, 130, 6).map((t) => t.at), [0, 50, 100]);
  near(ticks(0, 0.0031, 3)[1].at, 0.002, 1e-12);
});
