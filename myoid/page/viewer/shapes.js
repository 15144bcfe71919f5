// Geometries: surfaces of revolution, a torus, and several surfaces as one.
import { BufferAttribute, BufferGeometry, Vector3 } from 'three';

/** Turns a profile [[radius, z], ...] about the z axis. */
export function revolve(profile, sides = 24) {
  const positions = [];
  const indices = [];
  for (const [radius, z] of profile) {
    for (let s = 0; s <= sides; ++s) {
      const angle = (2 * Math.PI * s) / sides;
      positions.push(radius * Math.cos(angle), radius * Math.sin(angle), z);
    }
  }
  grid(indices, profile.length - 1, sides);
  return finished(positions, indices);
}

export function sphere(radius, sides = 20) {
  const profile = [];
  for (let i = 0; i <= sides / 2; ++i) {
    const angle = Math.PI * (i / (sides / 2) - 0.5);
    profile.push([radius * Math.cos(angle), radius * Math.sin(angle)]);
  }
  return revolve(profile, sides);
}

export const cylinder = (radius, length) =>
  revolve([[radius, -length / 2], [radius, length / 2]], 40);

export function torus(tube, ring) {
  const positions = [];
  const indices = [];
  const around = 48;
  const across = 16;
  for (let i = 0; i <= around; ++i) {
    const a = (2 * Math.PI * i) / around;
    for (let k = 0; k <= across; ++k) {
      const b = (2 * Math.PI * k) / across;
      const radius = ring + tube * Math.cos(b);
      positions.push(radius * Math.cos(a), radius * Math.sin(a), tube * Math.sin(b));
    }
  }
  grid(indices, around, across);
  return finished(positions, indices);
}

/** A long bone along z from 0 to `length`, thicker at its ends; `radius` is that of its middle. */
export function bone(radius, length) {
  const head = Math.min(0.1 * length, 3 * radius);
  const ends = [0, 0.5, 1, 1.5, 2.2].map((heads) => heads * head);
  const profile = [[0, -0.9 * radius], [0.9 * radius, -0.7 * radius]];
  for (const z of [...ends, ...ends.map((end) => length - end).reverse()])
    profile.push([radius * (0.85 + 0.75 * Math.exp(-((Math.min(z, length - z) / head) ** 2))), z]);
  profile.push([0.9 * radius, length + 0.7 * radius], [0, length + 0.9 * radius]);
  return revolve(profile, 12);
}

function grid(indices, rows, columns) {
  const width = columns + 1;
  for (let i = 0; i < rows; ++i) {
    for (let k = 0; k < columns; ++k) {
      const a = i * width + k;
      indices.push(a, a + 1, a + width + 1, a, a + width + 1, a + width);
    }
  }
}

function finished(positions, indices) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setIndex(indices);
  geometry.computeVertexNormals();
  return geometry;
}

/** A surface of triangles. */
export function surface({ vertices, corners }) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(vertices, 3));
  geometry.setIndex(new BufferAttribute(corners, 1));
  geometry.computeVertexNormals();
  return geometry;
}

/** The surface turned about the origin and moved. */
export function placed(geometry, place, turn) {
  for (const [name, by] of [['position', place], ['normal', new Vector3()]]) {
    const attribute = geometry.getAttribute(name);
    const v = new Vector3();
    for (let i = 0; i < attribute.count; ++i) {
      v.fromBufferAttribute(attribute, i).applyQuaternion(turn).add(by);
      attribute.setXYZ(i, v.x, v.y, v.z);
    }
  }
  return geometry;
}

/** Several surfaces as one. */
export function merged(geometries) {
  const joined = (name, size) => {
    const parts = geometries.map((g) => g.getAttribute(name).array);
    const all = new Float32Array(parts.reduce((sum, p) => sum + p.length, 0));
    parts.reduce((at, p) => (all.set(p, at), at + p.length), 0);
    return new BufferAttribute(all, size);
  };
  const indices = [];
  let first = 0;
  for (const g of geometries) {
    for (const i of g.index.array) indices.push(first + i);
    first += g.getAttribute('position').count;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', joined('position', 3));
  geometry.setAttribute('normal', joined('normal', 3));
  geometry.setIndex(indices);
  return geometry;
}
