// The repetitions of a movement as one band: mean ± 1 standard deviation over percent of the movement.

const STEPS = 100;
const FEWEST = 3;  // a standard deviation of two says nothing

/** Movement and number of a repetition: "slow_2", "slow rep 2" and "slow_T2" are number 2 of "slow"; null without a number. */
function counted(name) {
  const found = name.match(/^(.*?)[\s_.-]*(?:(?:rep|trial|run|t|r)[\s_.-]*)?(\d+)$/i);
  return found && found[1] ? { movement: found[1], number: Number(found[2]) } : null;
}

/**
 * The trials that repeat this one, itself included: three or more of one movement, numbered up to twice their count.
 * Larger numbers are angles or loads ("ramp_72"). Else empty.
 */
export function repetitions(trials, trial) {
  const { movement } = counted(trial.name) || {};
  const found = trials.filter((t) => movement && counted(t.name)?.movement === movement);
  const most = found.reduce((largest, t) => Math.max(largest, counted(t.name).number), 0);
  return found.length >= FEWEST && most <= 2 * found.length ? found : [];
}

/** The value of a curve at x, between its samples; NaN outside and in gaps. */
export function between(curve, x) {
  const { x: at, y } = curve;
  const last = at.length - 1;
  if (last < 0 || x < at[0] - 1e-9 || x > at[last] + 1e-9) return NaN;
  let k = 0;
  for (let high = last; high - k > 1; ) {
    const middle = (k + high) >> 1;
    if (at[middle] <= x) k = middle;
    else high = middle;
  }
  if (last === 0 || at[k + 1] === at[k]) return y[k];
  const share = Math.min(1, Math.max(0, (x - at[k]) / (at[k + 1] - at[k])));
  return share === 0 ? y[k] : y[k] + share * (y[k + 1] - y[k]);
}

/**
 * The band of the curves, each from its trial's begin (0 %) to its end (100 %), drawn over the extent `onto`.
 * `parts`: { curve, extent } of each repetition. Where fewer than three have a value, the band has a gap. Null: no band.
 */
export function band(parts, onto) {
  if (parts.length < FEWEST) return null;
  const x = new Float64Array(STEPS + 1);
  const y = new Float64Array(STEPS + 1).fill(NaN);
  const upper = new Float64Array(STEPS + 1).fill(NaN);
  for (let i = 0; i <= STEPS; ++i) {
    const along = ([from, to]) => from + (i / STEPS) * (to - from);
    x[i] = along(onto);
    const values = parts.map((p) => between(p.curve, along(p.extent))).filter(Number.isFinite);
    if (values.length < FEWEST) continue;
    const mean = values.reduce((sum, v) => sum + v, 0) / values.length;
    const sd = Math.sqrt(values.reduce((sum, v) => sum + (v - mean) ** 2, 0) / (values.length - 1));
    y[i] = mean - sd;
    upper[i] = mean + sd;
  }
  return y.some(Number.isFinite) ? { name: `mean ± 1 SD of ${parts.length} repetitions`, role: 'spread', x, y, upper, places: parts[0].curve.places } : null;
}
