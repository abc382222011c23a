import type { Shot } from "../state/shots";
import type { KeysView } from "./draw-keys";
import { font, INK } from "./ink";
import { does } from "../../words/editor-does/en";

/** Room between two blocks, and to the row's edges, pixels. */
const GAP = 1;
const AIR = 3;
const NAMED = 34;

/** Draw the camera's shots as blocks along a row. */
export function drawShots(
  context: CanvasRenderingContext2D,
  view: KeysView,
  shots: readonly Shot[],
  y: number,
  height: number,
): void {
  context.font = font(10);
  shots.forEach(({ start, end }, index) => {
    const left = (start - view.from) * view.scale + GAP;
    const right = (end - view.from) * view.scale - GAP;
    if (right < 0 || left > view.width || right <= left) return;
    context.beginPath();
    context.roundRect(left, y + AIR, right - left, height - 2 * AIR, 3);
    context.fillStyle = INK.brassWash;
    context.fill();
    context.strokeStyle = INK.bar;
    context.lineWidth = 1;
    context.stroke();
    if (right - left < NAMED) return;
    context.fillStyle = INK.soft;
    context.fillText(
      does.shotNumber({ number: index + 1 }),
      Math.max(left, 0) + 9,
      y + height / 2 + 3.5,
      right - Math.max(left, 0) - 12,
    );
  });
}
