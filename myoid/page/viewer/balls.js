// Balls of one size and color, drawn in one call.
import { InstancedMesh, Matrix4 } from 'three';
import { sphere } from './shapes.js';

export class Balls {
  constructor(count, radius, material) {
    this.mesh = new InstancedMesh(sphere(radius, 10), material, count);
    this.mesh.frustumCulled = false;
    this.matrix = new Matrix4();
  }

  /** Draws the first `count` balls only; `place(i)`: where ball i is. */
  put(count, place) {
    for (let i = 0; i < count; ++i) this.mesh.setMatrixAt(i, this.matrix.setPosition(place(i)));
    this.mesh.count = count;
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}
