import { equal, near, test } from './testing.js';
import { Tubes } from './tubes.js';

const RADIUS = 0.01;

/** Two tubes of at most four points; the first lies along x, with a corner to y. */
function made() {
  const all = new Tubes([{ capacity: 4, radius: RADIUS }, { capacity: 4, radius: RADIUS }]);
  const points = [[0, 0, 0], [0.5, 0, 0], [0.5, 0.4, 0]];
  points.forEach((p, i) => all.tubes[0].points[i].fromArray(p));
  all.tubes[0].update(3);
  return all;
}
const vertex = (all, i) => [0, 1, 2].map((k) => all.positions.array[3 * i + k]);
const PER_TUBE = (all) => all.positions.count / 2;

test('the first ring of a tube lies about its first point', () => {
  const all = made();
  for (let i = 0; i < 6; ++i) {
    const [x, y, z] = vertex(all, i);
    near(x, 0, 1e-6);
    near(Math.hypot(y, z), RADIUS, 1e-6);
  }
});

test('rings beyond the last point lie on the last ring', () => {
  const all = made();
  const sides = (PER_TUBE(all) - 2) / 4;
  for (let s = 0; s < sides; ++s) equal(vertex(all, 3 * sides + s), vertex(all, 2 * sides + s));
});

test('a tube that is hidden or has one point has no surface', () => {
  const all = made();
  all.tubes[0].visible = false;
  all.tubes[0].update(3);
  equal([...all.positions.array].every((x) => x === 0), true);
  all.tubes[0].visible = true;
  all.tubes[0].update(1);
  equal([...all.positions.array].every((x) => x === 0), true);
});

test('a color is that of one tube alone', () => {
  const all = made();
  all.tubes[1].paint(1, 0.5, 0.25);
  const n = 3 * PER_TUBE(all);
  equal([...all.colors.array.slice(0, n)].every((c) => c === 0), true);
  equal([...all.colors.array.slice(n, n + 3)], [1, 0.5, 0.25]);
});

test('every corner of a triangle is a vertex', () => {
  const all = made();
  equal(Math.max(...all.geometry.index.array) < all.positions.count, true);
});
