import { Player } from './player.js';
import { equal, near, test } from './testing.js';

const trial = { duration: 2, frames: 5, times: [1, 1.5, 2, 2.5, 3], frameAt: (seconds) => Math.round(2 * seconds) };
function made() {
  const player = new Player(() => {});
  player.open(trial);
  return player;
}

test('time passes while it plays, as fast as chosen', () => {
  const player = made();
  player.advance(0.5);
  equal(player.seconds, 0);
  player.toggle();
  player.speed = 0.5;
  player.advance(1);
  near(player.seconds, 0.5, 1e-12);
});

test('it begins anew at the end, or stops there', () => {
  const player = made();
  player.toggle();
  player.advance(2.25);
  near(player.seconds, 0.25, 1e-12);
  player.loop = false;
  player.advance(5);
  equal([player.seconds, player.playing], [2, false]);
});

test('steps stay within the trial', () => {
  const player = made();
  player.step(3);
  equal(player.frame, 3);
  player.step(Infinity);
  equal(player.frame, 4);
  player.step(-Infinity);
  equal(player.frame, 0);
});
