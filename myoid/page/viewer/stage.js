// What surrounds the model: lights, ground with its grid, axes; and the renderer.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  Fog,
  Group,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  PCFShadowMap,
  Scene,
  ShadowMaterial,
  Vector3,
  VertexColors,
  WebGLRenderer,
} from 'three';
import { revolve } from './shapes.js';

const BACKGROUND = 0x20262d;
const GRID = 0x53606e;

export class Stage {
  constructor(canvas, axes, size) {
    this.axes = axes;
    this.size = size;
    // Edges are smooth by more pixels than the screen has (pace.js), which a moving body can do without.
    this.renderer = new WebGLRenderer({ canvas, antialias: false });
    this.renderer.debug.checkShaderErrors = false;  // waiting for the answer holds up the page
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.scene = new Scene();
    this.scene.background = new Color(BACKGROUND);
    this.scene.fog = new Fog(BACKGROUND, 1, 2);
    this.ground = new Group();
    this.scene.add(this.ground);
    this.origin = this.#arrows();
    this.scene.add(this.origin);
    this.#light();
  }

  #light() {
    const { up, forward, right } = this.axes;
    const sky = new HemisphereLight(0xf4f7ff, 0x59514a, 0.6);
    sky.position.copy(up);
    this.sun = new DirectionalLight(0xfff4e2, 0.5);
    this.sunFrom = new Vector3().addScaledVector(up, 2).addScaledVector(forward, 0.9).addScaledVector(right, 0.8);
    this.sunFrom.multiplyScalar(this.size);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.radius = 2;
    const frame = this.sun.shadow.camera;
    frame.left = frame.bottom = -this.size;
    frame.right = frame.top = this.size;
    frame.near = 0.1 * this.size;
    frame.far = 6 * this.size;
    // From where one looks, so that nothing one sees is dark.
    this.lamp = new DirectionalLight(0xffffff, 0.3);
    this.scene.add(sky, this.sun, this.sun.target, this.lamp, this.lamp.target);
  }

  /** Ground at `height` along up about `center`: lines at round distances that fade away. */
  layGround(height, center, radius) {
    const { up, forward, right } = this.axes;
    const step = roundLength(this.size / 7);
    const count = Math.ceil(radius / step);
    const nearest = (axis) => Math.round(center.dot(axis) / step);
    const [a0, b0] = [nearest(forward), nearest(right)];
    const places = [];
    const colors = [];
    const near = new Color(GRID);
    const far = new Color(BACKGROUND);
    const color = new Color();
    const put = (a, b) => {
      const p = new Vector3().addScaledVector(forward, (a0 + a) * step).addScaledVector(right, (b0 + b) * step).addScaledVector(up, height);
      places.push(p.x, p.y, p.z);
      color.copy(near).lerp(far, Math.min(1, Math.hypot(a, b) / count));
      colors.push(color.r, color.g, color.b);
    };
    for (let i = -count; i <= count; ++i) {
      for (let k = -count; k < count; ++k) {
        if (Math.hypot(i, k) > count) continue;
        put(i, k);
        put(i, k + 1);
        put(k, i);
        put(k + 1, i);
      }
    }
    const lines = new BufferGeometry();
    lines.setAttribute('position', new BufferAttribute(new Float32Array(places), 3));
    lines.setAttribute('color', new BufferAttribute(new Float32Array(colors), 3));
    const grid = new LineSegments(lines, new LineBasicMaterial({ vertexColors: VertexColors }));
    const shadow = new Mesh(revolve([[0, 0], [radius, 0]], 64), new ShadowMaterial({ opacity: 0.45, depthWrite: false, side: 2 }));
    shadow.receiveShadow = true;
    shadow.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), up);
    shadow.position.copy(center).addScaledVector(up, height - center.dot(up) - 0.0005 * this.size);
    this.ground.add(shadow, grid);
    this.shade = shadow;
  }

  /** x red, y green, z blue, from the origin of ground. */
  #arrows() {
    const group = new Group();
    const length = 0.14 * this.size;
    const thin = 0.016 * length;
    const profile = [[0, 0], [thin, 0], [thin, 0.8 * length], [3 * thin, 0.8 * length], [0, length]];
    const colors = [0xe5484d, 0x46a758, 0x3e8bff];
    colors.forEach((color, k) => {
      const mesh = new Mesh(revolve(profile, 12), new MeshBasicMaterial({ color }));
      const along = new Vector3().setComponent(k, 1);
      mesh.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), along);
      group.add(mesh);
    });
    return group;
  }

  resize(width, height) {
    this.renderer.setSize(width, height, false);
  }

  /** How finely the next pictures are drawn (pace.js). */
  setLevel({ pixels, shadows }) {
    this.renderer.setPixelRatio(pixels);
    this.renderer.shadowMap.autoUpdate = shadows;
    this.shadows = shadows;
  }

  draw(camera) {
    this.shade.visible = this.shadows;
    this.sun.target.position.copy(camera.target);
    this.sun.position.addVectors(camera.target, this.sunFrom);
    this.lamp.target.position.copy(camera.target);
    this.lamp.position.copy(camera.camera.position);
    this.scene.fog.near = 3.2 * camera.distance;
    this.scene.fog.far = 7 * camera.distance;
    this.renderer.render(this.scene, camera.camera);
  }
}

/** The nearest of 1, 2, 5 times a power of ten. */
function roundLength(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return [1, 2, 5, 10].map((n) => n * power).reduce((a, b) => (Math.abs(b - length) < Math.abs(a - length) ? b : a));
}
