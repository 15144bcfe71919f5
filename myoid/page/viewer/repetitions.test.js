import { band, between, repetitions } from './repetitions.js';
import { equal, near, test } from './testing.js';

const trials = (...names) => names.map((name) => ({ name }));
const found = (names, of) => repetitions(trials(...names), { name: of }).map((t) => t.name);

test('repetitions have one name and small numbers', () => {
  equal(found(['slow_1', 'slow_2', 'slow_3', 'fast_1'], 'slow_2'), ['slow_1', 'slow_2', 'slow_3']);
  equal(found(['walk T1', 'walk T2', 'walk T3'], 'walk T1'), ['walk T1', 'walk T2', 'walk T3']);
  equal(found(['ramp_40', 'ramp_72', 'ramp_100'], 'ramp_40'), []);
  equal(found(['slow_1', 'slow_2'], 'slow_1'), []);
});

test('a value between samples, and none outside', () => {
  const curve = { x: [0, 1, 3], y: [0, 10, 30] };
  equal([between(curve, 0.5), between(curve, 2)], [5, 20]);
  equal(Number.isNaN(between(curve, 3.1)), true);
});

test('the band is mean and standard deviation over percent', () => {
  const part = (y, length) => ({ curve: { x: [0, length], y, places: 1 }, extent: [0, length] });
  const { x, y, upper } = band([part([0, 10], 1), part([2, 12], 2), part([4, 20], 5)], [10, 20]);
  near(x[100], 20, 1e-12);
  near(y[0], 2 - 2, 1e-12);
  near(upper[0], 2 + 2, 1e-12);
  const sd = Math.sqrt(((10 - 14) ** 2 + (12 - 14) ** 2 + (20 - 14) ** 2) / 2);
  near(upper[100], 14 + sd, 1e-12);
  equal(band([part([0, 1], 1), part([0, 1], 1)], [0, 1]), null);
});
