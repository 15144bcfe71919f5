import { mesh } from './decode.js';
import { equal, near, test } from './testing.js';

const bytes = (array) => btoa(String.fromCharCode(...new Uint8Array(array.buffer)));

test('a surface is made of steps from its origin', () => {
  const { vertices, corners } = mesh({
    origin: [1, 2, 3], step: 0.001, wide: false, vertices: bytes(Uint16Array.of(0, 0, 0, 1000, 0, 0, 0, 500, 65535)), corners: bytes(Uint16Array.of(0, 1, 2)),
  });
  equal([...corners], [0, 1, 2]);
  [1, 2, 3, 2, 2, 3, 1, 2.5, 68.535].forEach((expected, i) => near(vertices[i], expected, 1e-5));
});
