// What the modules' own tests (*.test.js) use. tests/pipeline/viewer_modules.test.cpp runs them in a browser.
const tests = [];

export const test = (name, check) => tests.push({ name, check });

export function equal(found, expected) {
  const [a, b] = [found, expected].map((value) => JSON.stringify(value));
  if (a !== b) throw new Error(`${a} instead of ${b}`);
}

export function near(found, expected, tolerance) {
  if (!(Math.abs(found - expected) <= tolerance)) throw new Error(`${found} instead of ${expected} ± ${tolerance}`);
}

/** Numbers of a normal distribution, always the same. */
export function normal(seed) {
  let state = seed;
  const uniform = () => (state = (state * 16807) % 2147483647) / 2147483647;
  return () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());
}

/** [name, failure] of each test; no failure: an empty text. */
export const results = () => tests.map(({ name, check }) => {
  try {
    check();
    return [name, ''];
  } catch (error) {
    return [name, error.message];
  }
});
