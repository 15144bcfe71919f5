// Contours of highest density about draws of two numbers.

const CELLS = 96;  // of the grid, along each side

/** Mean and covariance of weighted draws as the map (u, v) -> (x, y) that gives unit vectors their spread. */
function spread(x, y, weight) {
  const mean = (f) => weight.reduce((sum, w, i) => sum + w * f(i), 0);
  const mx = mean((i) => x[i]);
  const my = mean((i) => y[i]);
  const sx = Math.sqrt(mean((i) => (x[i] - mx) ** 2));
  const slope = mean((i) => (x[i] - mx) * (y[i] - my)) / sx;
  const rest = Math.sqrt(mean((i) => (y[i] - my) ** 2) - slope ** 2);
  return {
    known: sx > 0 && rest > 1e-9 * Math.abs(my),
    apart: (i) => [(x[i] - mx) / sx, (y[i] - my - (slope * (x[i] - mx)) / sx) / rest],
    together: (u, v) => [mx + sx * u, my + slope * u + rest * v],
  };
}

/** The grid smoothed by a Gaussian kernel along one side; `next`: from one node to the next. */
function smoothed(grid, size, next, width) {
  const reach = Math.ceil(4 * width);
  const kernel = Array.from({ length: 2 * reach + 1 }, (_, k) => Math.exp(-0.5 * ((k - reach) / width) ** 2));
  const result = new Float64Array(grid.length);
  for (let node = 0; node < grid.length; ++node) {
    if (!grid[node]) continue;
    const at = Math.floor(node / next) % size;
    for (let k = Math.max(-reach, -at); k <= Math.min(reach, size - 1 - at); ++k) result[node + k * next] += kernel[k + reach] * grid[node];
  }
  return result;
}

/** Closed lines on which the grid has this level, in steps of the grid: marching squares, the greater values to the left. */
function lines(grid, size, level) {
  const after = new Map();  // edge of a cell that a line crosses: the edge it crosses next
  const inside = (i, j) => grid[j * size + i] >= level;
  for (let j = 0; j + 1 < size; ++j) {
    for (let i = 0; i + 1 < size; ++i) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => inside(a, b));
      const edges = [2 * (j * size + i), 2 * (j * size + i + 1) + 1, 2 * ((j + 1) * size + i), 2 * (j * size + i) + 1];
      // A line enters by an edge from an inner to an outer corner, and leaves behind the inner corners before it.
      for (let k = 0; k < 4; ++k) {
        if (!corners[k] || corners[(k + 1) % 4]) continue;
        let out = (k + 3) % 4;
        while (corners[out]) out = (out + 3) % 4;
        after.set(edges[k], edges[out]);
      }
    }
  }
  const crossing = (edge) => {
    const node = edge >> 1;
    const [i, j] = [node % size, Math.floor(node / size)];
    const share = (level - grid[node]) / (grid[edge & 1 ? node + size : node + 1] - grid[node]);
    return edge & 1 ? [i, j + share] : [i + share, j];
  };
  const found = [];
  while (after.size) {
    const line = [];
    for (let edge = after.keys().next().value; after.has(edge); ) {
      line.push(crossing(edge));
      const next = after.get(edge);
      after.delete(edge);
      edge = next;
    }
    found.push(line);
  }
  return found;
}

/**
 * Of draws (x, y) whose weights add to 1, the regions of highest density that hold these shares of them: for each share
 * its closed lines of [x, y]. The density is a sum of Gaussian kernels with the covariance of the draws times n^(-1/3)
 * (Scott), n = 1 / sum of squared weights. Empty if the draws lie on a line.
 */
export function contours(x, y, weight, shares) {
  const { known, apart, together } = spread(x, y, weight);
  if (!known) return [];
  const width = weight.reduce((sum, w) => sum + w * w, 0) ** (1 / 6);
  const places = Array.from(weight, (_, i) => apart(i));
  const end = places.reduce((most, p) => Math.max(most, Math.abs(p[0]), Math.abs(p[1])), 0) + 4.5 * width;
  const step = (2 * end) / CELLS;
  const size = CELLS + 1;
  // Each draw's weight goes to the four nodes about it; the density at a draw is read from them in the same way.
  const nodes = ([u, v], visit) => {
    const [a, b] = [(u + end) / step, (v + end) / step];
    const [i, j] = [Math.floor(a), Math.floor(b)];
    for (const [di, dj] of [[0, 0], [1, 0], [0, 1], [1, 1]]) visit((j + dj) * size + i + di, (di ? a - i : 1 - a + i) * (dj ? b - j : 1 - b + j));
  };
  let grid = new Float64Array(size * size);
  places.forEach((p, k) => nodes(p, (node, part) => (grid[node] += part * weight[k])));
  grid = smoothed(smoothed(grid, size, 1, width / step), size, size, width / step);
  const at = places.map((p) => {
    let density = 0;
    nodes(p, (node, part) => (density += part * grid[node]));
    return density;
  });
  const falling = [...at.keys()].sort((p, q) => at[q] - at[p]);
  return shares.map((share) => {
    let sum = 0;
    const last = falling.find((i) => (sum += weight[i]) >= share) ?? falling[falling.length - 1];
    return lines(grid, size, at[last]).map((line) => line.map(([i, j]) => together(i * step - end, j * step - end)));
  });
}

const RADII = { 0.5: 1.1774, 0.95: 2.4477 };  // of a normal distribution in the plane

/** The same of two numbers whose logarithms are normal: value and spread of the logarithm of each, their correlation. */
export function ellipses(a, b, correlation, shares) {
  if (!(a.spread > 0 && b.spread > 0)) return [];
  const rest = Math.sqrt(Math.max(0, 1 - correlation ** 2));
  return shares.map((share) => [Array.from({ length: 72 }, (_, i) => {
    const [u, v] = [RADII[share] * Math.cos((Math.PI * i) / 36), RADII[share] * Math.sin((Math.PI * i) / 36)];
    return [a.value * Math.exp(a.spread * u), b.value * Math.exp(b.spread * (correlation * u + rest * v))];
  })]);
}
