/** Drag a handle in the plane that faces the camera. */

import { type Mesh, Plane, Raycaster, Vector2, Vector3 } from "three";

import type { LabView } from "./view";

/** The handle is caught this many pixels around its centre. */
const NEAR = 26;

export interface Drag {
  /** Where the handle is in the window, CSS pixels. */
  place(): { x: number; y: number };
  stop(): void;
}

/**
 * Let a pointer move a handle.
 *
 * @param handle what is caught
 * @param moved is told where it would come to lie, in the scene
 */
export function dragging(
  view: LabView,
  canvas: HTMLCanvasElement,
  handle: () => Mesh | null,
  moved: (point: [number, number, number]) => void,
): Drag {
  const ray = new Raycaster();
  const pointer = new Vector2();
  const plane = new Plane();
  const point = new Vector3();
  const normal = new Vector3();
  let caught: number | null = null;

  function place(): { x: number; y: number } {
    const box = canvas.getBoundingClientRect();
    view.camera.updateMatrixWorld();
    point.copy(handle()?.position ?? point.set(0, 0, 0)).project(view.camera);
    return { x: box.left + ((point.x + 1) / 2) * box.width, y: box.top + ((1 - point.y) / 2) * box.height };
  }

  function near(event: PointerEvent): boolean {
    if (handle() === null) return false;
    const { x, y } = place();
    return Math.hypot(event.clientX - x, event.clientY - y) < NEAR;
  }

  function down(event: PointerEvent): void {
    const mesh = handle();
    if (mesh === null || event.button !== 0 || !near(event)) return;
    caught = event.pointerId;
    view.controls.enabled = false;
    plane.setFromNormalAndCoplanarPoint(view.camera.getWorldDirection(normal), mesh.position);
    canvas.setPointerCapture(event.pointerId);
    event.stopImmediatePropagation();
  }

  function move(event: PointerEvent): void {
    if (caught !== event.pointerId) {
      canvas.style.cursor = near(event) ? "grab" : "";
      return;
    }
    const box = canvas.getBoundingClientRect();
    pointer.set(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    ray.setFromCamera(pointer, view.camera);
    canvas.style.cursor = "grabbing";
    if (ray.ray.intersectPlane(plane, point) !== null) moved([point.x, point.y, point.z]);
  }

  function up(event: PointerEvent): void {
    if (caught !== event.pointerId) return;
    caught = null;
    view.controls.enabled = true;
    canvas.style.cursor = "";
  }

  // Before the camera's own listeners, so that a caught handle does not turn the view.
  const options = { capture: true } as const;
  canvas.addEventListener("pointerdown", down, options);
  canvas.addEventListener("pointermove", move, options);
  canvas.addEventListener("pointerup", up, options);
  canvas.addEventListener("pointercancel", up, options);
  return {
    place,
    stop() {
      canvas.removeEventListener("pointerdown", down, options);
      canvas.removeEventListener("pointermove", move, options);
      canvas.removeEventListener("pointerup", up, options);
      canvas.removeEventListener("pointercancel", up, options);
      canvas.style.cursor = "";
      view.controls.enabled = true;
    },
  };
}
