/** The camera: the show's, until a person takes it, and again once they give it back. */

import { PerspectiveCamera, Quaternion, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { fitFieldOfView } from "./framing";

/** How long the way back to the show's camera takes, milliseconds. */
const RETURN_MS = 180;
const DEGREES = 180 / Math.PI;

export interface ShowPose {
  readonly position: Vector3;
  readonly target: Vector3;
  /** Vertical for 16:9, radians. */
  fov: number;
  /** Radians; positive tips the picture's top to the left. */
  roll: number;
}

/** Stand a camera where the show has it; its field of view is left alone. */
export function aim(camera: PerspectiveCamera, { position, target, roll }: ShowPose): void {
  camera.position.copy(position);
  camera.lookAt(target);
  camera.rotateZ(-roll);
}

export interface StageCameraOptions {
  readonly reducedMotion: boolean;
  onTaken(taken: boolean): void;
  /** The picture changed without a frame. */
  onChange(): void;
}

export class StageCamera {
  readonly camera = new PerspectiveCamera(30, 1, 0.05, 60);
  /** What the show asks for; set before `follow`. */
  readonly show: ShowPose = { position: new Vector3(0, 1.3, 3), target: new Vector3(0, 1.2, 0), fov: 0.5, roll: 0 };
  readonly #options: StageCameraOptions;
  readonly #controls: OrbitControls<PerspectiveCamera>;
  readonly #goal = new PerspectiveCamera();
  readonly #fromPosition = new Vector3();
  readonly #fromRotation = new Quaternion();
  #fromFov = 0;
  #returnedAt = Number.NEGATIVE_INFINITY;
  #taken = false;
  #heldFov = 0;
  #aspect = 1;

  constructor(element: HTMLElement, options: StageCameraOptions) {
    this.#options = options;
    this.#controls = new OrbitControls(this.camera, element);
    this.#controls.minDistance = 0.25;
    this.#controls.maxDistance = 9;
    this.#controls.maxPolarAngle = Math.PI * 0.52;
    this.#controls.cursor.set(0, 1.1, 0);
    this.#controls.maxTargetRadius = 2;
    this.#controls.addEventListener("start", () => this.take());
    this.#controls.addEventListener("change", () => {
      if (this.#taken) options.onChange();
    });
  }

  get taken(): boolean {
    return this.#taken;
  }

  /** On its way back to the show, so that pictures are due without frames. */
  get returning(): boolean {
    return !this.#taken && performance.now() - this.#returnedAt < RETURN_MS;
  }

  resize(aspect: number): void {
    this.#aspect = aspect;
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** Leave the camera where it is, to be orbited about what the show looks at. */
  take(): void {
    if (this.#taken) return;
    this.#taken = true;
    this.#returnedAt = Number.NEGATIVE_INFINITY;
    this.#heldFov = this.show.fov;
    this.#controls.target.copy(this.show.target);
    this.#controls.update();
    this.#options.onTaken(true);
  }

  /** Go back to the show's camera. */
  giveBack(): void {
    if (!this.#taken) return;
    this.#taken = false;
    this.#fromPosition.copy(this.camera.position);
    this.#fromRotation.copy(this.camera.quaternion);
    this.#fromFov = this.#heldFov;
    this.#returnedAt = this.#options.reducedMotion ? Number.NEGATIVE_INFINITY : performance.now();
    this.#options.onTaken(false);
    this.#options.onChange();
  }

  /** Set the camera for the picture that is about to be drawn. */
  follow(): void {
    const { camera, show } = this;
    let fov = this.#heldFov;
    if (!this.#taken) {
      const goal = this.#goal;
      aim(goal, show);
      this.#controls.target.copy(show.target);
      const elapsed = (performance.now() - this.#returnedAt) / RETURN_MS;
      if (elapsed < 1) {
        const share = 1 - (1 - elapsed) ** 3;
        camera.position.lerpVectors(this.#fromPosition, goal.position, share);
        camera.quaternion.slerpQuaternions(this.#fromRotation, goal.quaternion, share);
        fov = this.#fromFov + (show.fov - this.#fromFov) * share;
      } else {
        camera.position.copy(goal.position);
        camera.quaternion.copy(goal.quaternion);
        fov = show.fov;
      }
    }
    const vertical = fitFieldOfView(fov, this.#aspect) * DEGREES;
    if (Math.abs(vertical - camera.fov) > 1e-6) {
      camera.fov = vertical;
      camera.updateProjectionMatrix();
    }
    camera.updateMatrixWorld();
  }

  dispose(): void {
    this.#controls.dispose();
  }
}
