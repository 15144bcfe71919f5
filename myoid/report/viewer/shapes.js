// Geometries: surfaces of revolution, a torus, and tubes along changing lines.
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
  const profile = [[0, -0.9 * radius], [0.9 * radius, -0.7 * radius]];
  for (let i = 0; i <= 24; ++i) {
    const z = (length * i) / 24;
    const end = Math.min(z, length - z);
    profile.push([radius * (0.85 + 0.75 * Math.exp(-((end / head) ** 2))), z]);
  }
  profile.push([0.9 * radius, length + 0.7 * radius], [0, length + 0.9 * radius]);
  return revolve(profile, 16);
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

const SIDES = 8;

/** A tube along a line of at most `capacity` points that may change from frame to frame. */
export class Tube {
  constructor(capacity, radius) {
    this.radius = radius;
    this.capacity = capacity;
    this.points = Array.from({ length: capacity }, () => new Vector3());
    this.count = 0;
    this.geometry = new BufferGeometry();
    // Every ring, and the middle of each end.
    const vertices = capacity * SIDES + 2;
    this.positions = new BufferAttribute(new Float32Array(3 * vertices), 3);
    this.normals = new BufferAttribute(new Float32Array(3 * vertices), 3);
    this.geometry.setAttribute('position', this.positions);
    this.geometry.setAttribute('normal', this.normals);
    this.tangent = new Vector3();
    this.side = new Vector3();
    this.other = new Vector3();
    this.before = new Vector3();
    this.after = new Vector3();
  }

  /** Draws the first `count` of `points`. */
  update(count) {
    if (count !== this.count) this.#index(count);
    this.count = count;
    if (count < 2) return;
    this.#firstSide();
    for (let i = 0; i < count; ++i) this.#ring(i);
    this.#end(this.capacity * SIDES, 0, -1);
    this.#end(this.capacity * SIDES + 1, count - 1, 1);
    this.positions.needsUpdate = true;
    this.normals.needsUpdate = true;
  }

  #index(count) {
    const indices = [];
    for (let i = 0; i + 1 < count; ++i) {
      for (let s = 0; s < SIDES; ++s) {
        const a = i * SIDES + s;
        const b = i * SIDES + ((s + 1) % SIDES);
        indices.push(a, b, b + SIDES, a, b + SIDES, a + SIDES);
      }
    }
    const last = (count - 1) * SIDES;
    for (let s = 0; s < SIDES && count > 1; ++s) {
      const next = (s + 1) % SIDES;
      indices.push(this.capacity * SIDES, next, s, this.capacity * SIDES + 1, last + s, last + next);
    }
    this.geometry.setIndex(indices);
  }

  /** Any direction across the first piece. */
  #firstSide() {
    this.#direction(0, this.tangent);
    this.side.set(0, 0, 0);
    const { x, y, z } = this.tangent;
    const least = Math.abs(x) <= Math.abs(y) && Math.abs(x) <= Math.abs(z) ? 'x' : Math.abs(y) <= Math.abs(z) ? 'y' : 'z';
    this.side[least] = 1;
  }

  /** Unit vector along the piece after point i; zero where two points coincide. */
  #direction(i, result) {
    return result.subVectors(this.points[i + 1], this.points[i]).normalize();
  }

  #ring(i) {
    this.#direction(Math.max(0, i - 1), this.before);
    this.#direction(Math.min(this.count - 2, i), this.after);
    this.tangent.addVectors(this.before, this.after).normalize();
    // The side is carried along and kept square to the line; at a corner the ring is a miter.
    this.side.addScaledVector(this.tangent, -this.side.dot(this.tangent)).normalize();
    this.other.crossVectors(this.tangent, this.side);
    const bend = Math.max(0.5, this.tangent.dot(this.before));
    const p = this.points[i];
    for (let s = 0; s < SIDES; ++s) {
      const angle = (2 * Math.PI * s) / SIDES;
      const c = Math.cos(angle);
      const d = Math.sin(angle);
      const x = c * this.side.x + d * this.other.x;
      const y = c * this.side.y + d * this.other.y;
      const z = c * this.side.z + d * this.other.z;
      const r = this.radius / Math.sqrt(bend);
      this.positions.setXYZ(i * SIDES + s, p.x + r * x, p.y + r * y, p.z + r * z);
      this.normals.setXYZ(i * SIDES + s, x, y, z);
    }
  }

  /** A blunt tip beyond an end. */
  #end(vertex, i, sign) {
    this.#direction(sign < 0 ? 0 : this.count - 2, this.tangent).multiplyScalar(sign);
    const p = this.points[i];
    const r = 0.8 * this.radius;
    const t = this.tangent;
    this.positions.setXYZ(vertex, p.x + r * t.x, p.y + r * t.y, p.z + r * t.z);
    this.normals.setXYZ(vertex, t.x, t.y, t.z);
  }
}
