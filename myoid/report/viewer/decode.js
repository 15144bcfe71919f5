// The scene as the page brings it (see scene_page.cpp and packing.h), made readable.

const MISSING = 65535;

function bytes(text) {
  const raw = atob(text);
  const result = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) result[i] = raw.charCodeAt(i);
  return result.buffer;
}

export const halves = (text) => new Uint16Array(bytes(text));
export const floats = (text) => new Float32Array(bytes(text));

/** A surface: its vertices and the corners of its triangles. */
export function mesh(data) {
  const numbers = halves(data.vertices);
  const vertices = new Float32Array(numbers.length);
  numbers.forEach((n, i) => (vertices[i] = data.origin[i % 3] + data.step * n));
  const corners = bytes(data.corners);
  return { vertices, corners: data.wide ? new Uint32Array(corners) : new Uint16Array(corners) };
}

/** One trial: the model, and what stands where in each frame. Positions in meters, in ground. */
export class Trial {
  constructor(data) {
    this.model = data;
    this.name = data.name;
    this.notes = data.notes;
    this.frames = data.frames;
    this.times = floats(data.times);
    this.origin = data.origin;
    this.step = data.step;
    this.positions = halves(data.positions);
    this.rotations = halves(data.rotations);
    this.angles = floats(data.angles);
    this.movingMuscles = data.lines.muscles;
    this.lineCounts = halves(data.lines.counts);
    this.linePoints = halves(data.lines.points);
    this.lineStarts = starts(this.lineCounts);
    this.values = data.values.map((v) => ({ ...v, numbers: halves(v.numbers) }));
    this.loads = (data.loads || []).map((load) => ({ name: load.name, points: halves(load.points), forces: floats(load.forces) }));
    this.measured = data.measured ? { ...data.measured, points: halves(data.measured.points) } : null;
  }

  get duration() {
    return this.times[this.frames - 1] - this.times[0];
  }

  /** The frame that is nearest to `seconds` after the first one. */
  frameAt(seconds) {
    const time = this.times[0] + seconds;
    let low = 0;
    let high = this.frames - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle;
    }
    return time - this.times[low] <= this.times[high] - time ? low : high;
  }

  /** Writes where a body is into a three.js object. */
  place(frame, body, object) {
    const at = frame * this.model.bodies.length + body;
    this.#point(this.positions, 3 * at, object.position);
    const r = this.rotations;
    object.quaternion
      .set(r[4 * at] / 32767 - 1, r[4 * at + 1] / 32767 - 1, r[4 * at + 2] / 32767 - 1, r[4 * at + 3] / 32767 - 1)
      .normalize();
  }

  coordinate(frame, index) {
    return this.angles[frame * this.model.coordinates.length + index];
  }

  /** Calls `add(index, point)` for each point of the line of the k-th moving muscle; how many. */
  line(frame, k, point, add) {
    const at = frame * this.movingMuscles.length + k;
    const count = this.lineCounts[at];
    for (let i = 0; i < count; ++i) {
      this.#point(this.linePoints, 3 * (this.lineStarts[at] + i), point);
      add(i, point);
    }
    return count;
  }

  mostPoints(k) {
    let most = 0;
    for (let at = k; at < this.lineCounts.length; at += this.movingMuscles.length)
      most = Math.max(most, this.lineCounts[at]);
    return most;
  }

  /** The muscle's value, or null where it is not known. */
  value(values, frame, muscle) {
    const n = values.numbers[frame * this.model.muscles.length + muscle];
    return n === MISSING ? null : (values.top * n) / (MISSING - 1);
  }

  /** Writes a measured marker's place into `point`; false where it was not seen. */
  measuredPoint(frame, index, point) {
    const at = 3 * (frame * this.measured.names.length + index);
    if (this.measured.points[at] === MISSING) return false;
    this.#point(this.measured.points, at, point);
    return true;
  }

  /** Writes where a measured force acts, and the force [N]; false while there is none. */
  load(frame, index, point, force) {
    const { points, forces } = this.loads[index];
    if (points[3 * frame] === MISSING) return false;
    this.#point(points, 3 * frame, point);
    force.fromArray(forces, 3 * frame);
    return true;
  }

  /** The greatest measured force [N]. */
  get greatestLoad() {
    let top = 0;
    for (const { forces } of this.loads)
      for (let i = 0; i < forces.length; i += 3) top = Math.max(top, Math.hypot(forces[i], forces[i + 1], forces[i + 2]));
    return top;
  }

  #point(numbers, at, point) {
    point.set(
      this.origin[0] + this.step * numbers[at],
      this.origin[1] + this.step * numbers[at + 1],
      this.origin[2] + this.step * numbers[at + 2]
    );
  }
}

function starts(counts) {
  const result = new Uint32Array(counts.length);
  for (let i = 1; i < counts.length; ++i) result[i] = result[i - 1] + counts[i - 1];
  return result;
}
