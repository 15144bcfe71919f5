// The scene as the page brings it (see scene_page.cpp and packing.h), made readable.

/** Of a packed range, and the codes of a value and of a place that are not there. */
export const STEPS = 4094;
export const MISSING = 4095;
const NO_PLACE = 16383;
const MOST_ONES = 24;
const UNIT = 8191;  // steps of a quaternion's component

function bytes(text) {
  const raw = atob(text);
  const result = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) result[i] = raw.charCodeAt(i);
  return result.buffer;
}

/** The codes that packed_codes of packing.h wrote, in rows of `columns`. */
export function codes(text, columns = 1) {
  const raw = new Uint8Array(bytes(text));
  let at = 0;  // [bits]
  const bit = () => (raw[at >> 3] >> (7 - (at++ & 7))) & 1;
  const number = (count) => {
    let value = 0;
    for (let i = 0; i < count; ++i) value = 2 * value + bit();
    return value;
  };
  const result = new Uint16Array(number(32));
  for (let c = 0; c < columns; ++c) {
    const order = number(2);
    const k = number(4);
    if (order === 3) continue;
    let last = 0;
    let slope = 0;
    for (let i = c; i < result.length; i += columns) {
      let ones = 0;
      while (ones < MOST_ONES && bit()) ++ones;
      const folded = ones === MOST_ONES ? number(16) : (ones << k) + number(k);
      const difference = folded & 1 ? -((folded + 1) >> 1) : folded >> 1;
      result[i] = difference + (order === 0 ? 0 : order === 1 ? last : last + slope);
      slope = i === c ? 0 : result[i] - last;
      last = result[i];
    }
  }
  return result;
}

export const floats = (text) => new Float32Array(bytes(text));

/** Packed numbers; NaN where one is missing. `quantum`: the step of the packing. */
export function numbers(data) {
  const found = codes(data.codes);
  const quantum = (data.upper - data.lower) / STEPS;
  const values = new Float64Array(found.length);
  for (let i = 0; i < found.length; ++i) values[i] = found[i] === MISSING ? NaN : data.lower + quantum * found[i];
  return { values, quantum, lower: data.lower, upper: data.upper };
}

export function clock(data) {
  if (data.times) return Float64Array.from(floats(data.times));
  return Float64Array.from({ length: data.count }, (_, i) => data.start + i * data.step);
}

/** A surface: its vertices and the corners of its triangles. */
export function mesh(data) {
  const numbers = codes(data.vertices, 3);
  const vertices = new Float32Array(numbers.length);
  numbers.forEach((n, i) => (vertices[i] = data.origin[i % 3] + data.step * n));
  return { vertices, corners: data.wide ? new Uint32Array(bytes(data.corners)) : codes(data.corners, 3) };
}

/** One trial: the model, and what stands where in each frame. Positions in meters, in ground. */
export class Trial {
  constructor(data, models) {
    this.model = models[data.model];
    const bodies = this.model.bodies.length;
    this.name = data.name;
    this.notes = data.notes;
    this.frames = data.frames;
    this.times = clock(data.times);
    this.origin = data.origin;
    this.step = data.step;
    this.positions = codes(data.positions, 3 * bodies);
    this.rotations = codes(data.rotations, 4 * bodies);
    this.angles = data.angles.map((a) => numbers(a).values);
    this.movingMuscles = data.lines.muscles;
    this.lineCounts = codes(data.lines.counts, Math.max(1, this.movingMuscles.length));
    this.linePoints = codes(data.lines.points, data.lines.columns);
    this.lineStarts = starts(this.lineCounts);
    this.values = data.values.map((v) => ({ ...v, numbers: codes(v.numbers, Math.max(1, this.model.muscles.length)) }));
    this.loads = (data.loads || []).map((load) => ({ name: load.name, points: codes(load.points, 3), forces: floats(load.forces) }));
    this.measured = data.measured ? { ...data.measured, points: codes(data.measured.points, Math.max(3, 3 * data.measured.names.length)) } : null;
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
      .set(r[4 * at] / UNIT - 1, r[4 * at + 1] / UNIT - 1, r[4 * at + 2] / UNIT - 1, r[4 * at + 3] / UNIT - 1)
      .normalize();
  }

  coordinate(frame, index) {
    return this.angles[index][frame];
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
    return n === MISSING ? null : (values.top * n) / STEPS;
  }

  /** Writes a measured marker's place into `point`; false where it was not seen. */
  measuredPoint(frame, index, point) {
    const at = 3 * (frame * this.measured.names.length + index);
    if (this.measured.points[at] === NO_PLACE) return false;
    this.#point(this.measured.points, at, point);
    return true;
  }

  /** Writes where a measured force acts, and the force [N]; false while there is none. */
  load(frame, index, point, force) {
    const { points, forces } = this.loads[index];
    if (points[3 * frame] === NO_PLACE) return false;
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
