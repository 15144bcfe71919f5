import { Quaternion, Vector3 } from 'three';
import { bone, merged, placed, sphere } from './shapes.js';
import { equal, near, test } from './testing.js';

const vertices = (geometry) => {
  const at = geometry.getAttribute('position');
  return Array.from({ length: at.count }, (_, i) => new Vector3().fromBufferAttribute(at, i));
};

test('a sphere has its radius', () => {
  for (const v of vertices(sphere(0.3, 10))) near(v.length(), 0.3, 1e-6);
});

test('a bone is thicker at its ends, and alike at both', () => {
  const at = vertices(bone(0.01, 0.4));
  const thickest = (from, to) => Math.max(...at.filter((v) => v.z >= from && v.z <= to).map((v) => Math.hypot(v.x, v.y)));
  near(thickest(-0.001, 0.001), 0.016, 1e-4);
  near(thickest(0.399, 0.401), 0.016, 1e-4);
  equal(thickest(0.06, 0.34) < 0.009, true);
});

test('a surface that is placed turns with its normals', () => {
  const quarter = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(1, 0, 0));
  const before = sphere(0.1, 8);
  const after = placed(sphere(0.1, 8), new Vector3(1, 2, 3), quarter);
  const normal = (g, i) => new Vector3().fromBufferAttribute(g.getAttribute('normal'), i);
  vertices(after).forEach((v, i) => {
    near(v.distanceTo(vertices(before)[i].applyQuaternion(quarter).add(new Vector3(1, 2, 3))), 0, 1e-6);
    near(normal(after, i).distanceTo(normal(before, i).applyQuaternion(quarter)), 0, 1e-6);
  });
});

test('merged surfaces keep their triangles', () => {
  const [a, b] = [sphere(0.1, 8), bone(0.01, 0.3)];
  const all = merged([a, b]);
  equal(all.index.count, a.index.count + b.index.count);
  const corner = (g, k) => vertices(g)[g.index.array[k]];
  near(corner(all, a.index.count + 5).distanceTo(corner(b, 5)), 0, 1e-9);
});
