// A camera that turns about a point: drag turns, right or shift drag moves, the wheel zooms; keys do
// the same.
import { PerspectiveCamera, Vector3 } from 'three';

const FIELD_DEG = 32;

/** Ground's axes as people see them: up, forward (x, or z where x is up) and to the right. */
export function directions(up) {
  const u = new Vector3().fromArray(up).normalize();
  const forward = Math.abs(u.x) > 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  forward.addScaledVector(u, -forward.dot(u)).normalize();
  return { up: u, forward, right: new Vector3().crossVectors(forward, u) };
}

export class Camera {
  constructor(element, up, changed) {
    this.axes = directions(up);
    this.camera = new PerspectiveCamera(FIELD_DEG, 1, 0.01, 100);
    this.camera.up.copy(this.axes.up);
    this.target = new Vector3();
    this.distance = 3;
    this.azimuth = 0;
    this.elevation = 0;
    this.changed = changed;
    this.#listen(element);
    this.view('oblique');
  }

  /** Azimuth 0 looks from the front, growing towards the right-hand side. */
  view(name) {
    const views = {
      front: [0, 0],
      back: [Math.PI, 0],
      side: [Math.PI / 2, 0],
      left: [-Math.PI / 2, 0],
      top: [Math.PI / 2, Math.PI / 2 - 1e-3],
      oblique: [0.95, 0.22],
    };
    [this.azimuth, this.elevation] = views[name];
    this.#place();
  }

  /** Brings a ball into view. */
  fit(center, radius) {
    this.target.copy(center);
    this.extent = radius;
    const narrow = Math.min(1, this.camera.aspect);
    this.distance = radius / Math.sin((FIELD_DEG * Math.PI) / 360) / narrow;
    this.#place();
  }

  resize(width, height) {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  turn(azimuth, elevation) {
    this.azimuth += azimuth;
    this.elevation = Math.min(1.57, Math.max(-1.57, this.elevation + elevation));
    this.#place();
  }

  zoom(factor) {
    this.distance = Math.min(1000, Math.max(0.02, this.distance * factor));
    this.#place();
  }

  /** Moves the target by shares of the picture's height. */
  pan(right, up) {
    const height = 2 * this.distance * Math.tan((FIELD_DEG * Math.PI) / 360);
    const e = this.camera.matrixWorld.elements;
    this.target.x += height * (right * e[0] + up * e[4]);
    this.target.y += height * (right * e[1] + up * e[5]);
    this.target.z += height * (right * e[2] + up * e[6]);
    this.#place();
  }

  /** Moves camera and target alike. */
  shift(by) {
    this.target.add(by);
    this.#place();
  }

  #place() {
    const { up, forward, right } = this.axes;
    const flat = Math.cos(this.elevation) * this.distance;
    this.camera.position
      .copy(this.target)
      .addScaledVector(forward, flat * Math.cos(this.azimuth))
      .addScaledVector(right, flat * Math.sin(this.azimuth))
      .addScaledVector(up, this.distance * Math.sin(this.elevation));
    this.camera.near = this.distance / 100;
    this.camera.far = this.distance * 20 + 20 * (this.extent || 1);
    this.camera.updateProjectionMatrix();
    this.camera.lookAt(this.target);
    this.camera.updateMatrixWorld();
    this.changed();
  }

  #listen(element) {
    const fingers = new Map();
    element.addEventListener('contextmenu', (event) => event.preventDefault());
    element.addEventListener('pointerdown', (event) => {
      fingers.set(event.pointerId, event);
      element.setPointerCapture(event.pointerId);
    });
    const lift = (event) => fingers.delete(event.pointerId);
    element.addEventListener('pointerup', lift);
    element.addEventListener('pointercancel', lift);
    element.addEventListener('pointermove', (event) => {
      const last = fingers.get(event.pointerId);
      if (!last) return;
      fingers.set(event.pointerId, event);
      const dx = (event.clientX - last.clientX) / element.clientHeight;
      const dy = (event.clientY - last.clientY) / element.clientHeight;
      if (fingers.size === 2) {
        const [other] = [...fingers.values()].filter((f) => f.pointerId !== event.pointerId);
        this.zoom(apart(last, other) / Math.max(1, apart(event, other)));
        this.pan(-dx / 2, dy / 2);
      } else if (event.buttons & 6 || event.shiftKey) {
        this.pan(-dx, dy);
      } else {
        this.turn(4 * dx, 4 * dy);
      }
    });
    element.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        this.zoom(Math.exp((event.deltaMode ? 30 : 1) * event.deltaY * 0.001));
      },
      { passive: false }
    );
  }
}

const apart = (a, b) => Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
