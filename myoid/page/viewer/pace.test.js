import { Pace } from './pace.js';
import { equal, test } from './testing.js';

/** Draws `count` frames of so many milliseconds; the level at their end. */
function play(pace, count, ms) {
  for (let i = 0, last = null; i < count; ++i, last = i * ms) pace.move((i + 1) * ms, last);
  return pace.level;
}

test('a fast machine draws every frame finely', () => {
  const applied = [];
  const pace = new Pace((level) => applied.push(level.pixels));
  equal(applied, [1]);  // the first picture comes soon
  equal(play(pace, 100, 16.7), 0);
  equal(applied, [1, 2]);
});

test('long frames are drawn coarser until they are short', () => {
  const pace = new Pace(() => {});
  equal(play(pace, 20, 40), 3);
  equal(play(pace, 20, 16.7), 3);
  equal(play(pace, 200, 40), 5);
});

test('one long frame among others changes nothing', () => {
  const pace = new Pace(() => {});
  for (let i = 1; i < 60; ++i) pace.move(i, i - (i % 6 ? 16.7 : 90));
  equal(pace.level, 0);
});

test('a body at rest is drawn finely, and moves a level finer than before', () => {
  const pace = new Pace(() => {});
  play(pace, 20, 40);
  equal(pace.isDue(1000, 950), false);
  equal(pace.isDue(1300, 950), true);
  pace.rest();
  equal(pace.level, 0);
  equal(pace.isDue(2000, 950), false);
  equal(play(pace, 2, 40), 2);
});

test('a film keeps its size', () => {
  const pace = new Pace(() => {});
  pace.rest();
  pace.held = true;
  equal(play(pace, 50, 80), 0);
});
