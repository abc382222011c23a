import { INK } from "./ink";

/** Grips of the chosen keyframes' span, pixels. */
export const GRIP = 7;

/** Draw the bar over the chosen keyframes: taken in the middle it moves them, at a grip it stretches them. */
export function drawSpan(context: CanvasRenderingContext2D, from: number, to: number, y: number, height: number): void {
  const [top, room] = [y + 2, height - 4];
  context.fillStyle = INK.brassWash;
  context.fillRect(from, top, to - from, room);
  context.fillStyle = INK.brass;
  context.fillRect(from, top + room / 2 - 1, to - from, 2);
  for (const x of to - from > 2 * GRIP ? [from, to - GRIP] : [from - GRIP, to]) {
    context.beginPath();
    context.roundRect(x, top, GRIP, room, 2);
    context.fill();
  }
}

/** Draw the box that chooses keyframes. */
export function drawBox(
  context: CanvasRenderingContext2D,
  box: { x0: number; y0: number; x1: number; y1: number },
): void {
  const [x, y] = [Math.min(box.x0, box.x1), Math.min(box.y0, box.y1)];
  const [w, h] = [Math.abs(box.x1 - box.x0), Math.abs(box.y1 - box.y0)];
  context.fillStyle = INK.brassWash;
  context.fillRect(x, y, w, h);
  context.strokeStyle = INK.light;
  context.lineWidth = 1;
  context.strokeRect(x + 0.5, y + 0.5, w, h);
}
