/** The camera: the show's, until a person takes it, and again once they give it back. */

import { PerspectiveCamera, Quaternion, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { type CameraView, type FramedView, lookedAt } from "./camera-presets";
import { fitFrame, type Insets, widen } from "./framing";

/** How long the way to another view takes, milliseconds. */
const MOVE_MS = 180;
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
  /** The view that a person asked for. */
  readonly #held: ShowPose = { position: new Vector3(), target: new Vector3(), fov: 0.5, roll: 0 };
  readonly #goal = new PerspectiveCamera();
  readonly #fromPosition = new Vector3();
  readonly #fromRotation = new Quaternion();
  #fromFov = 0;
  #movedAt = Number.NEGATIVE_INFINITY;
  #taken = false;
  #width = 1;
  #height = 1;
  #insets: Insets = { top: 0, right: 0, bottom: 0, left: 0 };
  #widening = 1;

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

  /** On its way to another view, so that pictures are due without frames; it ends with the picture from there. */
  get moving(): boolean {
    return this.#movedAt > Number.NEGATIVE_INFINITY;
  }

  /** How far what is looked at lies from the camera, metres. */
  get targetDistance(): number {
    return this.camera.position.distanceTo(this.#taken ? this.#controls.target : this.show.target);
  }

  /** Of the canvas, CSS pixels. */
  get size(): { readonly width: number; readonly height: number } {
    return { width: this.#width, height: this.#height };
  }

  resize(width: number, height: number): void {
    this.#width = Math.max(1, width);
    this.#height = Math.max(1, height);
    this.#frame();
  }

  setSafeArea(insets: Insets): void {
    this.#insets = insets;
    this.#frame();
  }

  #frame(): void {
    const { camera } = this;
    const { widening, shiftX, shiftY } = fitFrame(this.#width, this.#height, this.#insets);
    this.#widening = widening;
    camera.aspect = this.#width / this.#height;
    if (shiftX === 0 && shiftY === 0) camera.clearViewOffset();
    else camera.setViewOffset(this.#width, this.#height, -shiftX, -shiftY, this.#width, this.#height);
    camera.updateProjectionMatrix();
  }

  /** Leave the camera where it is, to be orbited about what the show looks at. */
  take(): void {
    this.#movedAt = Number.NEGATIVE_INFINITY;
    if (this.#taken) return;
    this.#held.fov = this.show.fov;
    this.#controls.target.copy(this.show.target);
    this.#setTaken(true);
    this.#controls.update();
  }

  /** Take the camera around what it looks at: to its own right and up for positive angles, radians. */
  orbitBy(azimuth: number, elevation: number): void {
    this.take();
    this.#controls.rotateLeft(-azimuth);
    this.#controls.rotateUp(elevation);
  }

  /** Take the camera to so many times its distance from what it looks at. */
  dollyBy(factor: number): void {
    this.take();
    this.#controls.dollyIn(factor);
  }

  /** Take the camera to a view; from there it can be orbited. */
  view({ position, target, fov }: FramedView): void {
    this.#leave(this.#taken ? this.#held.fov : this.show.fov);
    this.#held.position.fromArray(position);
    this.#held.target.fromArray(target);
    this.#held.fov = fov;
    this.#controls.target.copy(this.#held.target);
    this.#setTaken(true);
    if (!this.moving) this.#arrive();
    this.#options.onChange();
  }

  /** Go back to the show's camera. */
  giveBack(): void {
    if (!this.#taken) return;
    this.#leave(this.#held.fov);
    this.#setTaken(false);
    this.#options.onChange();
  }

  /** The view that is seen, as a show's camera keys hold it. */
  current(): CameraView {
    const { position, target, fov, roll } = this.show;
    if (!this.#taken) return { position: position.toArray(), target: target.toArray(), fov, roll };
    const stand = this.moving ? this.#held.position : this.camera.position;
    const ahead = new Vector3().subVectors(this.#controls.target, stand).normalize();
    const seen = lookedAt(stand, ahead, this.#controls.target);
    return { position: stand.toArray(), target: seen.toArray(), fov: this.#held.fov, roll: 0 };
  }

  #setTaken(taken: boolean): void {
    if (this.#taken === taken) return;
    this.#taken = taken;
    this.#options.onTaken(taken);
  }

  /** Begin to move, from what is seen now. */
  #leave(fov: number): void {
    this.#fromPosition.copy(this.camera.position);
    this.#fromRotation.copy(this.camera.quaternion);
    this.#fromFov = fov;
    this.#movedAt = this.#options.reducedMotion ? Number.NEGATIVE_INFINITY : performance.now();
  }

  /** Stand where a person asked for. */
  #arrive(): void {
    this.#movedAt = Number.NEGATIVE_INFINITY;
    this.camera.position.copy(this.#held.position);
    this.#controls.update();
  }

  /** Set the camera for the picture that is about to be drawn. */
  follow(): void {
    const { camera, show } = this;
    const wanted = this.#taken ? this.#held : show;
    const elapsed = (performance.now() - this.#movedAt) / MOVE_MS;
    let fov = wanted.fov;
    if (!this.#taken) this.#controls.target.copy(show.target);
    if (elapsed < 1) {
      const goal = this.#goal;
      aim(goal, wanted);
      const share = 1 - (1 - elapsed) ** 3;
      camera.position.lerpVectors(this.#fromPosition, goal.position, share);
      camera.quaternion.slerpQuaternions(this.#fromRotation, goal.quaternion, share);
      fov = this.#fromFov + (wanted.fov - this.#fromFov) * share;
    } else if (!this.#taken) {
      this.#movedAt = Number.NEGATIVE_INFINITY;
      aim(camera, show);
    } else if (this.#movedAt > 0) {
      this.#arrive();
    }
    const vertical = widen(fov, this.#widening) * DEGREES;
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
