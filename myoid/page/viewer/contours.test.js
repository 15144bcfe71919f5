import { contours, ellipses } from './contours.js';
import { equal, near, normal, test } from './testing.js';

const COUNT = 4000;

/** Draws of a normal distribution about (0.1, 800), correlated by −0.8. */
function draws() {
  const next = normal(7);
  const pairs = Array.from({ length: COUNT }, () => [next(), next()]);
  return { x: pairs.map(([u]) => 0.1 + 0.01 * u), y: pairs.map(([u, v]) => 800 + 200 * (-0.8 * u + 0.6 * v)), weight: pairs.map(() => 1 / COUNT) };
}

/** Distance of a pair from the middle of these draws, in standard deviations. */
const distance = ([x, y]) => {
  const u = (x - 0.1) / 0.01;
  return Math.hypot(u, ((y - 800) / 200 + 0.8 * u) / 0.6);
};

function holds(lines, [x, y]) {
  let inside = false;
  for (const line of lines) {
    line.forEach(([xa, ya], i) => {
      const [xb, yb] = line[(i + 1) % line.length];
      if (ya > y !== yb > y && x < xa + ((xb - xa) * (y - ya)) / (yb - ya)) inside = !inside;
    });
  }
  return inside;
}

test('contours hold the shares of the draws', () => {
  const { x, y, weight } = draws();
  const [outer, inner] = contours(x, y, weight, [0.95, 0.5]);
  const share = (lines) => x.filter((_, i) => holds(lines, [x[i], y[i]])).length / COUNT;
  // Between the nodes of its grid the level is off by a few draws.
  near(share(outer), 0.95, 0.005);
  near(share(inner), 0.5, 0.01);
});

test('contours of normal draws are ellipses', () => {
  const { x, y, weight } = draws();
  const [outer, inner] = contours(x, y, weight, [0.95, 0.5]);
  // Radii of the plane's normal distribution; 4,000 draws place a contour within some 15 %.
  for (const point of outer.flat()) near(distance(point), 2.4477, 0.4);
  for (const point of inner.flat()) near(distance(point), 1.1774, 0.2);
});

test('contours follow a bent ridge and leave out what lies beside it', () => {
  const next = normal(3);
  const x = Array.from({ length: COUNT }, next);
  const y = x.map((u) => u * u + 0.1 * next());
  const [outer] = contours(x, y, x.map(() => 1 / COUNT), [0.95]);
  equal(holds(outer, [0, 0]), true);
  equal(holds(outer, [1.5, 2.25]), true);
  equal(holds(outer, [0, 2]), false);  // the middle of the arc: an ellipse would hold it
});

test('contours of two modes are two lines', () => {
  const next = normal(5);
  const x = Array.from({ length: COUNT }, (_, i) => (i % 2 ? 10 : 0) + next());
  const [outer] = contours(x, x.map(next), x.map(() => 1 / COUNT), [0.8]);
  equal(outer.length, 2);
});

test('a draw without weight does not count', () => {
  const { x, y, weight } = draws();
  const plain = contours(x, y, weight, [0.5])[0];
  const more = contours([...x, 0.1], [...y, 900], [...weight, 0], [0.5])[0];
  equal(more, plain);
});

test('draws on a line have no contours', () => equal(contours([1, 2, 3], [5, 5, 5], [0.3, 0.4, 0.3], [0.5]), []));

test('ellipses are normal in the logarithms', () => {
  const [[line]] = ellipses({ value: 0.1, spread: 0.2 }, { value: 800, spread: 0.3 }, 0.6, [0.95]);
  for (const [x, y] of line) {
    const u = Math.log(x / 0.1) / 0.2;
    near(Math.hypot(u, (Math.log(y / 800) / 0.3 - 0.6 * u) / 0.8), Math.sqrt(-2 * Math.log(0.05)), 1e-4);
  }
  equal(ellipses({ value: 0.1, spread: 0 }, { value: 800, spread: 0.3 }, 0, [0.95]), []);
});
