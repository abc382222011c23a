/** What stands above the floor, seen from below it: the picture that the floor gives back. */

import {
  HalfFloatType,
  LinearFilter,
  LinearMipmapLinearFilter,
  Matrix4,
  type Object3D,
  PerspectiveCamera,
  type Scene,
  type Texture,
  Vector3,
  WebGLRenderTarget,
  type WebGLRenderer,
} from "three";

/** From clip space to texture coordinates. */
const TO_TEXTURE = new Matrix4().set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1);

export class FloorMirror {
  /** From the world to the picture's texture coordinates, homogeneous. */
  readonly matrix = new Matrix4();
  readonly #target: WebGLRenderTarget;
  readonly #camera = new PerspectiveCamera();
  readonly #ahead = new Vector3();
  readonly #scale: number;

  /** @param scale size of the picture as a share of the window's. */
  constructor(scale: number) {
    this.#scale = scale;
    this.#target = new WebGLRenderTarget(16, 16, {
      type: HalfFloatType,
      generateMipmaps: true,
      minFilter: LinearMipmapLinearFilter,
      magFilter: LinearFilter,
      samples: 0,
    });
  }

  get texture(): Texture {
    return this.#target.texture;
  }

  resize(width: number, height: number): void {
    this.#target.setSize(Math.max(1, Math.round(width * this.#scale)), Math.max(1, Math.round(height * this.#scale)));
  }

  /** Draw the scene from under the floor; `hidden` is the floor itself. */
  render(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera, hidden: Object3D): void {
    if (camera.position.y <= 0) return;
    const mirrored = this.#camera;
    camera.getWorldDirection(this.#ahead).add(camera.position);
    mirrored.position.copy(camera.position).setY(-camera.position.y);
    // The camera's own up, turned over: the picture is then upright in the floor, with left and right kept.
    mirrored.up.set(0, 1, 0).applyQuaternion(camera.quaternion);
    mirrored.up.y *= -1;
    mirrored.lookAt(this.#ahead.setY(-this.#ahead.y));
    mirrored.updateMatrixWorld();
    mirrored.projectionMatrix.copy(camera.projectionMatrix);
    // Left and right are turned over in it, and so is a picture that is shifted to one side.
    const { elements } = mirrored.projectionMatrix;
    elements[8] *= -1;
    mirrored.projectionMatrixInverse.copy(mirrored.projectionMatrix).invert();
    this.matrix.multiplyMatrices(TO_TEXTURE, mirrored.projectionMatrix).multiply(mirrored.matrixWorldInverse);

    hidden.visible = false;
    renderer.setRenderTarget(this.#target);
    renderer.render(scene, mirrored);
    renderer.setRenderTarget(null);
    hidden.visible = true;
  }

  dispose(): void {
    this.#target.dispose();
  }
}
