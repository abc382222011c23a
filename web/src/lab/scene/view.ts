/** The lab's canvas: one camera, drawn only when something has changed. */

import {
  ACESFilmicToneMapping,
  type Group,
  PerspectiveCamera,
  Scene,
  Spherical,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { surround } from "./surroundings";
import { lab } from "../../words/lab/en";

/** How much of the canvas lies under panels, CSS pixels. */
export interface Insets {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** What a table of the lab shows. */
export interface Figure {
  readonly object: Group;
  /** Where to look and how large it is, in the scene's unit. */
  readonly frame: { readonly centre: readonly number[]; readonly radius: number; readonly from: readonly number[] };
  dispose(): void;
}

const FIELD_OF_VIEW = 32;
const SHARPEST = 2;

/** No WebGL 2 in this browser. */
export class LabUnavailableError extends Error {
  override readonly name = "LabUnavailableError";
}

export class LabView {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.001, 100);
  readonly controls: OrbitControls;
  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #unlight: () => void;
  readonly #observer: ResizeObserver;
  #figure: Figure | null = null;
  #insets: Insets = { left: 0, right: 0, top: 0, bottom: 0 };
  #asked = 0;
  /** How many pictures have been drawn. */
  drawn = 0;

  /** @throws LabUnavailableError where the browser gives no WebGL 2. */
  constructor(canvas: HTMLCanvasElement) {
    const context = canvas.getContext("webgl2", { antialias: true });
    if (context === null) {
      throw new LabUnavailableError(lab.noWebGl);
    }
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({ canvas, context, antialias: true });
    this.#renderer.outputColorSpace = SRGBColorSpace;
    this.#renderer.toneMapping = ACESFilmicToneMapping;
    this.#renderer.setPixelRatio(Math.min(window.devicePixelRatio, SHARPEST));
    this.#unlight = surround(this.#scene, this.#renderer);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomSpeed = 0.7;
    this.controls.addEventListener("change", () => this.request());
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(canvas);
    this.#resize();
  }

  /** Show a figure in place of the one before, framed. */
  show(figure: Figure): void {
    if (this.#figure !== null) this.#scene.remove(this.#figure.object);
    this.#figure = figure;
    this.#scene.add(figure.object);
    this.reframe();
  }

  /** Look at the whole figure from its own side. */
  reframe(): void {
    if (this.#figure === null) return;
    const { centre, radius, from } = this.#figure.frame;
    const { width, height } = this.#free();
    const whole = Math.max(this.#canvas.clientHeight, 1);
    // The angle that the free part of the canvas takes, across its smaller side.
    const half = Math.atan((Math.tan((FIELD_OF_VIEW * Math.PI) / 360) * Math.min(width, height)) / whole);
    const target = new Vector3(...centre);
    const away = new Vector3(...from).normalize().multiplyScalar(radius / Math.sin(half));
    this.camera.position.copy(target).add(away);
    this.camera.near = radius / 100;
    this.camera.far = radius * 100;
    this.controls.target.copy(target);
    this.controls.minDistance = radius * 0.5;
    this.controls.maxDistance = radius * 20;
    this.#arrange();
    this.controls.update();
    this.request();
  }

  /** Go round the figure, radians to the right and down. */
  orbit(right: number, down: number): void {
    const away = this.camera.position.clone().sub(this.controls.target);
    const place = new Spherical().setFromVector3(away);
    place.theta += right;
    place.phi += down;
    place.makeSafe();
    this.camera.position.copy(this.controls.target).add(away.setFromSpherical(place));
    this.controls.update();
    this.request();
  }

  /** Come nearer (below 1) or go away. */
  approach(factor: number): void {
    const away = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
    this.request();
  }

  /** Keep the figure in the middle of what the panels leave free. */
  setInsets(insets: Insets): void {
    const before = this.#insets;
    if (
      insets.left === before.left &&
      insets.right === before.right &&
      insets.top === before.top &&
      insets.bottom === before.bottom
    )
      return;
    this.#insets = insets;
    this.reframe();
  }

  /** Draw at the next opportunity. */
  request(): void {
    if (this.#asked !== 0) return;
    this.#asked = requestAnimationFrame(() => {
      this.#asked = 0;
      this.#renderer.render(this.#scene, this.camera);
      this.drawn += 1;
    });
  }

  dispose(): void {
    cancelAnimationFrame(this.#asked);
    this.#observer.disconnect();
    this.controls.dispose();
    this.#unlight();
    this.#renderer.dispose();
  }

  #free(): { width: number; height: number } {
    const { left, right, top, bottom } = this.#insets;
    return {
      width: Math.max(this.#canvas.clientWidth - left - right, 80),
      height: Math.max(this.#canvas.clientHeight - top - bottom, 80),
    };
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.#canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.#renderer.setSize(clientWidth, clientHeight, false);
    this.reframe();
  }

  #arrange(): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    const { left, right, top, bottom } = this.#insets;
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.setViewOffset(width, height, (right - left) / 2, (bottom - top) / 2, width, height);
    this.camera.updateProjectionMatrix();
  }
}
