// Tubes along lines that change from frame to frame, each of one color, drawn in one call.
import { BufferAttribute, BufferGeometry, Vector3 } from 'three';

const SIDES = 6;

/** One of the tubes: its line, and its place in the geometry of all. */
class Tube {
  constructor(all, first, capacity, radius) {
    this.all = all;
    this.first = first;  // vertex
    this.capacity = capacity;
    this.radius = radius;
    this.visible = true;
    this.points = Array.from({ length: capacity }, () => new Vector3());
    this.count = 0;
    for (const name of ['tangent', 'side', 'other', 'before', 'after']) this[name] = new Vector3();
  }

  /** Lays the tube along the first `count` of `points`. */
  update(count) {
    this.count = count;
    const { positions, normals } = this.all;
    positions.needsUpdate = normals.needsUpdate = true;
    const first = 3 * this.first;
    const end = 3 * (this.first + vertices(this.capacity));
    if (count < 2 || !this.visible) {
      positions.array.fill(0, first, end);
      return;
    }
    this.#firstSide();
    for (let i = 0; i < count; ++i) this.#ring(i);
    // Rings that the line does not need lie on its last.
    const last = 3 * (this.first + (count - 1) * SIDES);
    for (let i = count; i < this.capacity; ++i)
      for (const { array } of [positions, normals]) array.copyWithin(first + 3 * i * SIDES, last, last + 3 * SIDES);
    this.#end(this.first + this.capacity * SIDES, 0, -1);
    this.#end(this.first + this.capacity * SIDES + 1, count - 1, 1);
  }

  paint(red, green, blue) {
    const { colors } = this.all;
    for (let i = this.first; i < this.first + vertices(this.capacity); ++i) colors.setXYZ(i, red, green, blue);
    colors.needsUpdate = true;
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
    const r = this.radius / Math.sqrt(bend);
    const p = this.points[i];
    const { positions, normals } = this.all;
    for (let s = 0; s < SIDES; ++s) {
      const angle = (2 * Math.PI * s) / SIDES;
      const c = Math.cos(angle);
      const d = Math.sin(angle);
      const x = c * this.side.x + d * this.other.x;
      const y = c * this.side.y + d * this.other.y;
      const z = c * this.side.z + d * this.other.z;
      const at = this.first + i * SIDES + s;
      positions.setXYZ(at, p.x + r * x, p.y + r * y, p.z + r * z);
      normals.setXYZ(at, x, y, z);
    }
  }

  /** A blunt tip beyond an end. */
  #end(vertex, i, sign) {
    this.#direction(sign < 0 ? 0 : this.count - 2, this.tangent).multiplyScalar(sign);
    const p = this.points[i];
    const r = 0.8 * this.radius;
    const t = this.tangent;
    this.all.positions.setXYZ(vertex, p.x + r * t.x, p.y + r * t.y, p.z + r * t.z);
    this.all.normals.setXYZ(vertex, t.x, t.y, t.z);
  }
}

/** Of a tube: every ring, and the middle of each end. */
const vertices = (capacity) => capacity * SIDES + 2;

export class Tubes {
  /** `lines`: { capacity, radius }: the most points of each line. */
  constructor(lines) {
    const count = lines.reduce((sum, { capacity }) => sum + vertices(capacity), 0);
    for (const name of ['positions', 'normals', 'colors']) this[name] = new BufferAttribute(new Float32Array(3 * count), 3);
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute('position', this.positions);
    this.geometry.setAttribute('normal', this.normals);
    this.geometry.setAttribute('color', this.colors);
    const indices = [];
    let first = 0;
    this.tubes = lines.map(({ capacity, radius }) => {
      triangles(first, capacity, indices);
      const tube = new Tube(this, first, capacity, radius);
      first += vertices(capacity);
      return tube;
    });
    this.geometry.setIndex(indices);
  }
}

function triangles(first, capacity, indices) {
  for (let i = 0; i + 1 < capacity; ++i) {
    for (let s = 0; s < SIDES; ++s) {
      const a = first + i * SIDES + s;
      const b = first + i * SIDES + ((s + 1) % SIDES);
      indices.push(a, b, b + SIDES, a, b + SIDES, a + SIDES);
    }
  }
  const last = first + (capacity - 1) * SIDES;
  const tips = first + capacity * SIDES;
  for (let s = 0; s < SIDES && capacity > 1; ++s) {
    const next = (s + 1) % SIDES;
    indices.push(tips, first + next, first + s, tips + 1, last + s, last + next);
  }
}
