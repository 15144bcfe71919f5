import { colorOf } from './colors.js';
import { equal, test } from './testing.js';

test('colors grow brighter with the value, for every kind of sight', () => {
  const light = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
  const lights = Array.from({ length: 21 }, (_, i) => light(colorOf(i / 20)));
  equal(lights.every((l, i) => i === 0 || l > lights[i - 1]), true);
  equal([colorOf(-1), colorOf(2)], [colorOf(0), colorOf(1)]);
});
