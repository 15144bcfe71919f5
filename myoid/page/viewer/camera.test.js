import { Vector3 } from 'three';
import { Camera, directions } from './camera.js';
import { equal, near, test } from './testing.js';

const made = () => {
  const camera = new Camera(document.createElement('canvas'), [0, 1, 0], () => {});
  camera.resize(800, 600);
  return camera;
};

test('right, up and forward are a person’s', () => {
  const { up, forward, right } = directions([0, 0, 1]);
  near(up.distanceTo(new Vector3(0, 0, 1)), 0, 1e-12);
  near(forward.dot(up), 0, 1e-12);
  near(right.distanceTo(new Vector3().crossVectors(forward, up)), 0, 1e-12);
});

test('a ball that fits touches the edge of the picture, and lies in its middle', () => {
  const camera = made();
  const middle = new Vector3(1, 2, 3);
  camera.fit(middle, 0.5);
  near(middle.clone().project(camera.camera).x, 0, 1e-6);
  // The cone of sight touches the ball where the distance is the radius over the sine of half the field.
  const angle = Math.asin(0.5 / camera.camera.position.distanceTo(middle));
  near((2 * angle * 180) / Math.PI, 32, 1e-6);
});

test('the side view looks along the person’s left', () => {
  const camera = made();
  camera.view('side');
  const from = camera.camera.position.clone().sub(camera.target).normalize();
  near(from.dot(camera.axes.right), 1, 1e-6);
});

test('zooming has ends', () => {
  const camera = made();
  for (let i = 0; i < 200; ++i) camera.zoom(0.5);
  equal(camera.distance, 0.02);
});
