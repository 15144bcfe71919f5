// The numbers of the workbench as the page brings them (see workbench.cpp and packing.h), made readable.
import { numbers } from './decode.js';

/** The number of the value in rising `x` that is nearest to `at`. */
export function nearest(x, at) {
  let low = 0;
  let high = x.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] <= at) low = middle;
    else high = middle;
  }
  return high < 0 || at - x[low] <= x[high] - at ? low : high;
}

/** As many decimals as the packing keeps, at most four. */
export function decimals(quantum) {
  if (!(quantum > 0)) return 3;
  return Math.max(0, Math.min(4, Math.floor(-Math.log10(2 * quantum))));
}

export function text(value, places) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  const shown = value.toFixed(places);
  return /[1-9]/.test(shown) ? shown.replace('-', '−') : shown.replace('-', '');
}

/** A curve: name, role, x, y and, of a band, its upper edge. */
export function curve(line, x) {
  const y = numbers(line.value);
  return {
    name: line.name,
    role: line.role,
    x,
    y: y.values,
    upper: line.upper ? numbers(line.upper).values : null,
    places: decimals(y.quantum),
  };
}

/** Round numbers that cover [lower, upper] with about `count` intervals. */
export function ticks(lower, upper, count) {
  const rough = (upper - lower) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((f) => f * power).find((s) => s >= rough * (1 - 1e-9)) || 10 * power;
  const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const result = [];
  for (let k = Math.ceil(lower / step - 1e-9); k * step <= upper + 1e-9 * step; ++k)
    result.push({ at: k * step, label: text(k * step, places) });
  return result;
}
