// The model as three.js objects, put where a trial says.
import {
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshPhongMaterial,
  Quaternion,
  Vector3,
  VertexColors,
} from 'three';
import { Balls } from './balls.js';
import { MUSCLE, UNKNOWN, colorOf } from './colors.js';
import { bone, cylinder, merged, placed, revolve, sphere, surface, torus } from './shapes.js';
import { Tubes } from './tubes.js';

const BONE = 0xe6dcc3;
const CENTER = 0x8d99a6;
const MODEL_MARKER = 0xff6fae;
const MEASURED_MARKER = 0x5cc8ff;
const ERROR_LINE = 0xffb020;
const SURFACE = 0x4fd1b5;
const LOAD = 0xffe14d;

/** Parts that can be hidden, in the order they are offered. */
export const PARTS = [
  ['bones', 'Bones', 'b'],
  ['centers', 'Mass centers', 'c'],
  ['muscles', 'Muscles', 'u'],
  ['markers', 'Model markers', 'm'],
  ['measured', 'Measured markers', 'e'],
  ['errors', 'Marker errors', 'r'],
  ['loads', 'Measured forces', 'g'],
  ['surfaces', 'Wrap surfaces', 'w'],
];

const phong = (color, more = {}) =>
  new MeshPhongMaterial({ color, shininess: 40, specular: 0x222222, ...more });

export class Figure {
  /** `size`: how large the model is [m]; everything without a size of its own is made to suit. */
  constructor(trial, meshes, size) {
    this.trial = trial;
    this.meshes = meshes;
    this.model = trial.model;
    this.size = size;
    this.root = new Group();
    this.bodies = this.model.bodies.map(() => this.#added(this.root, new Group()));
    this.parts = Object.fromEntries(PARTS.map(([name]) => [name, []]));
    this.point = new Vector3();
    this.other = new Vector3();
    this.#addBones();
    this.#addSurfaces();
    this.#addMuscles();
    this.#addMarkers();
    this.#addLoads();
  }

  /** Which kinds of parts there are at all. */
  has(part) {
    return this.parts[part].length > 0;
  }

  show(part, visible) {
    if (part === 'loads') this.loadsShown = visible;
    for (const object of this.parts[part]) object.visible = visible;
  }

  showMuscle(index, visible) {
    this.tubes[index].visible = visible;
  }

  #added(parent, object) {
    parent.add(object);
    return object;
  }

  /** All bones of a body are one surface; a body without a surface of its own has sticks. */
  #addBones() {
    const material = phong(BONE);
    this.model.bodies.forEach((body, b) => {
      const pieces = body.meshes.length > 0 ? body.meshes.map((index) => surface(this.meshes[index])) : body.sticks.flatMap((stick) => this.#stick(...stick));
      if (pieces.length === 0) return;
      const mesh = this.#added(this.bodies[b], new Mesh(merged(pieces), material));
      mesh.castShadow = true;
      this.parts.bones.push(mesh);
    });
    this.heavy = this.model.bodies.flatMap((body, b) => (b > 0 && body.mass > 0 ? [b] : []));
    this.centers = this.#addBalls('centers', this.heavy.length, 0.0055 * this.size, CENTER);
  }

  /** A bone between two points; none where they are too near. */
  #stick(from, to) {
    const thinnest = 0.0025 * this.size;
    const start = this.point.fromArray(from);
    const along = this.other.fromArray(to).sub(start);
    const length = along.length();
    if (length < 4 * thinnest) return [];
    const radius = Math.min(0.008 * this.size, Math.max(thinnest, 0.04 * length));
    const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), along.normalize());
    return [placed(bone(radius, length), start, turn)];
  }

  #addBalls(part, count, radius, color) {
    if (count === 0) return null;
    const balls = new Balls(count, radius, phong(color));
    this.parts[part].push(this.#added(this.root, balls.mesh));
    return balls;
  }

  #addSurfaces() {
    const material = phong(SURFACE, { transparent: true, opacity: 0.28, depthWrite: false, side: 2 });
    for (const s of this.model.surfaces) {
      const [x, y, z] = s.size;
      let geometry = null;
      if (s.kind === 'cylinder') geometry = cylinder(x, z);
      else if (s.kind === 'torus') geometry = torus(x, y);
      else geometry = sphere(1, 28).scale(x, y, z);
      if (s.kind === 'ellipsoid') geometry.computeVertexNormals();
      const mesh = this.#added(this.bodies[s.body], new Mesh(geometry, material));
      mesh.position.fromArray(s.position);
      mesh.quaternion.fromArray(s.rotation);
      this.parts.surfaces.push(mesh);
    }
  }

  #addMuscles() {
    const thick = Math.min(2, Math.max(1, Math.sqrt(40 / (this.model.muscles.length || 1))));
    const all = new Tubes(this.model.muscles.map((muscle, m) => {
      const k = this.trial.movingMuscles.indexOf(m);
      const strength = Math.min(2, Math.max(0.5, Math.sqrt(muscle.strength / 1000)));
      return { capacity: k >= 0 ? this.trial.mostPoints(k) : muscle.points.length, radius: 0.0026 * this.size * thick * strength };
    }));
    this.tubes = all.tubes;
    if (this.tubes.length === 0) return;
    const material = phong(0xffffff, { vertexColors: VertexColors });
    // Light of its own keeps the color what it is in the legend, on the side of the shadow too.
    material.onBeforeCompile = (shader) => {
      shader.fragmentShader = shader.fragmentShader.replace('#include <emissivemap_fragment>', 'totalEmissiveRadiance = 0.3 * vColor;');
    };
    const mesh = this.#added(this.root, new Mesh(all.geometry, material));
    mesh.frustumCulled = false;
    mesh.castShadow = true;
    this.parts.muscles.push(mesh);
  }

  #addMarkers() {
    const radius = 0.0048 * this.size;
    this.markers = this.#addBalls('markers', this.model.markers.length, radius, MODEL_MARKER);
    if (!this.trial.measured) return;
    const most = this.trial.measured.names.length;
    this.seen = this.#addBalls('measured', most, radius, MEASURED_MARKER);
    this.measured = Array.from({ length: most }, () => ({ visible: false, position: new Vector3() }));
    const lines = new BufferGeometry();
    this.errorEnds = new BufferAttribute(new Float32Array(6 * most), 3);
    lines.setAttribute('position', this.errorEnds);
    this.errors = this.#added(this.root, new LineSegments(lines, new LineBasicMaterial({ color: ERROR_LINE })));
    this.errors.frustumCulled = false;
    this.parts.errors.push(this.errors);
  }

  /** An arrow for each measured force, as long as half the model at the greatest one, and a ball where it acts. */
  #addLoads() {
    const thin = 0.006 * this.size;
    const profile = [[0, 0], [thin, 0], [thin, 0.86], [3 * thin, 0.86], [0, 1]];
    this.newton = (0.5 * this.size) / (this.trial.greatestLoad || 1);
    this.force = new Vector3();
    this.arrows = this.trial.loads.map(() => {
      const group = this.#added(this.root, new Group());
      const material = phong(LOAD);
      const arrow = this.#added(group, new Mesh(revolve(profile, 12), material));
      this.#added(group, new Mesh(sphere(2.2 * thin, 12), material));
      this.parts.loads.push(group);
      return { group, arrow };
    });
    this.loadsShown = true;
  }

  #poseLoads(frame) {
    this.arrows.forEach(({ group, arrow }, i) => {
      const acts = this.trial.load(frame, i, group.position, this.force);
      group.visible = acts && this.loadsShown;
      if (!acts) return;
      const size = this.force.length();
      arrow.scale.set(1, 1, size * this.newton);
      arrow.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), this.force.divideScalar(size));
    });
  }

  /** Puts everything where it is in this frame. */
  pose(frame) {
    const { trial } = this;
    this.frame = frame;
    this.bodies.forEach((body, b) => trial.place(frame, b, body));
    this.root.updateMatrixWorld(true);
    this.model.muscles.forEach((muscle, m) => {
      const tube = this.tubes[m];
      muscle.points.forEach(([body, x, y, z], i) =>
        tube.points[i].set(x, y, z).applyMatrix4(this.bodies[body].matrixWorld)
      );
      if (muscle.points.length > 0) tube.update(muscle.points.length);
    });
    trial.movingMuscles.forEach((m, k) => {
      const tube = this.tubes[m];
      tube.update(trial.line(frame, k, this.point, (i, p) => tube.points[i].copy(p)));
    });
    if (this.centers) this.centers.put(this.heavy.length, (k) => this.massCenter(this.heavy[k], this.point));
    if (this.markers) this.markers.put(this.model.markers.length, (i) => this.markerPlace(i, this.point));
    if (this.measured) this.#poseMeasured(frame);
    this.#poseLoads(frame);
  }

  #poseMeasured(frame) {
    let ends = 0;
    this.measured.forEach((ball, i) => {
      ball.visible = this.trial.measuredPoint(frame, i, ball.position);
      const marker = this.trial.measured.markers[i];
      if (!ball.visible || marker < 0) return;
      this.markerPlace(marker, this.point);
      this.errorEnds.setXYZ(ends++, ball.position.x, ball.position.y, ball.position.z);
      this.errorEnds.setXYZ(ends++, this.point.x, this.point.y, this.point.z);
    });
    const seen = this.measured.filter((ball) => ball.visible);
    if (this.seen) this.seen.put(seen.length, (i) => seen[i].position);
    this.errorEnds.needsUpdate = true;
    this.errors.geometry.setDrawRange(0, ends);
  }

  massCenter(body, result) {
    return result.fromArray(this.model.bodies[body].center).applyMatrix4(this.bodies[body].matrixWorld);
  }

  markerPlace(marker, result) {
    const [body, x, y, z] = this.model.markers[marker].point;
    return result.set(x, y, z).applyMatrix4(this.bodies[body].matrixWorld);
  }

  /** From a measured marker to the model's [m]; null without one. */
  markerError(i) {
    const marker = this.trial.measured.markers[i];
    if (marker < 0 || !this.measured[i].visible) return null;
    return this.markerPlace(marker, this.point).distanceTo(this.measured[i].position);
  }

  /** Colors every muscle; `values` as in Trial, or null for one color. */
  paint(values) {
    this.tubes.forEach((tube, m) => {
      const glow = m === this.highlighted ? 2 : 1;
      tube.paint(...this.muscleColor(values, m).map((c) => (glow * c) / 255));
    });
  }

  muscleColor(values, m) {
    if (!values) return MUSCLE;
    const value = this.trial.value(values, this.frame, m);
    return value === null ? UNKNOWN : colorOf(value / values.top);
  }

  /** Gives back what the graphics card holds. */
  dispose() {
    this.root.traverse((object) => {
      if (object.geometry) object.geometry.dispose();
      if (object.material) object.material.dispose();
    });
  }

  highlight(muscle) {
    this.highlighted = muscle;
  }

  /** The mass center of all bodies. */
  center(result) {
    let mass = 0;
    result.set(0, 0, 0);
    for (const b of this.heavy) {
      result.addScaledVector(this.massCenter(b, this.point), this.model.bodies[b].mass);
      mass += this.model.bodies[b].mass;
    }
    return mass > 0 ? result.multiplyScalar(1 / mass) : result;
  }

  /** Every point that should be in the picture, through `visit`. */
  points(visit) {
    this.model.bodies.forEach((body, b) => {
      const ends = [...body.sticks.flat(), ...body.meshes.flatMap((index) => extremes(this.meshes[index].vertices))];
      for (const p of ends) visit(this.point.fromArray(p).applyMatrix4(this.bodies[b].matrixWorld));
    });
    for (const b of this.heavy) visit(this.massCenter(b, this.point));
    for (const tube of this.tubes) for (let i = 0; i < tube.count; ++i) visit(tube.points[i]);
    this.model.markers.forEach((_, i) => visit(this.markerPlace(i, this.point)));
  }

  /** What is nearest to a place on the screen: { kind, index } or null. `project` takes a point to
   * [x, y, depth] in pixels. */
  pick(x, y, project) {
    const reach = 9;
    let best = null;
    const consider = (kind, index, distance, depth, bonus) => {
      const cost = distance - bonus;
      if (distance <= reach && (!best || cost < best.cost - 1 || (cost < best.cost + 1 && depth < best.depth)))
        best = { kind, index, cost, depth };
    };
    const visible = (part) => this.parts[part].length > 0 && this.parts[part][0].visible;
    const near = (kind, index, point, bonus) => {
      const [px, py, depth] = project(point);
      consider(kind, index, Math.hypot(px - x, py - y), depth, bonus);
    };
    if (visible('markers')) this.model.markers.forEach((_, i) => near('marker', i, this.markerPlace(i, this.other), 4));
    if (this.measured && visible('measured'))
      this.measured.forEach((ball, i) => ball.visible && near('measured', i, ball.position, 4));
    if (visible('centers')) for (const b of this.heavy) near('body', b, this.massCenter(b, this.other), 1);
    const alongLine = (kind, index, points, bonus) => {
      let last = null;
      for (const point of points) {
        const here = project(point);
        if (last) consider(kind, index, ...toPiece(x, y, last, here), bonus);
        last = here;
      }
    };
    if (visible('muscles'))
      this.tubes.forEach((tube, m) => tube.visible && alongLine('muscle', m, tube.points.slice(0, tube.count), 2));
    if (visible('bones')) {
      this.model.bodies.forEach((body, b) => {
        for (const stick of body.sticks)
          alongLine('body', b, stick.map((p) => new Vector3().fromArray(p).applyMatrix4(this.bodies[b].matrixWorld)), 0);
      });
    }
    return best;
  }
}

/** Two corners of the box about vertices. */
function extremes(vertices) {
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  vertices.forEach((x, i) => {
    lower[i % 3] = Math.min(lower[i % 3], x);
    upper[i % 3] = Math.max(upper[i % 3], x);
  });
  return vertices.length > 0 ? [lower, upper] : [];
}

/** Distance of a place to the piece a-b of the screen, and the depth there. */
function toPiece(x, y, a, b) {
  const dx = b[0] - a[0];
  const dy = b[1] - a[1];
  const square = dx * dx + dy * dy;
  const share = square > 0 ? Math.min(1, Math.max(0, ((x - a[0]) * dx + (y - a[1]) * dy) / square)) : 0;
  return [Math.hypot(a[0] + share * dx - x, a[1] + share * dy - y), a[2] + share * (b[2] - a[2])];
}
