import { firstFrom } from "../state/key-times";
import { hexOf } from "../state/parameter-value";
import type { ShowTrack } from "../state/show-document";
import { INK } from "./ink";
import { DIAMOND } from "./layout";

/** A track's row as it is drawn. */
export interface KeyRow {
  /** Middle of the row, pixels. */
  readonly y: number;
  readonly track: ShowTrack;
  /** Song times of its keyframes, seconds. */
  readonly times: Float64Array;
  readonly isColor: boolean;
  /** Muted, or left out because another plays alone. */
  readonly silent: boolean;
  readonly chosen: ReadonlySet<string> | null;
  /** A group's row shows the keyframes of its tracks smaller. */
  readonly small: boolean;
}

export interface KeysView {
  readonly from: number;
  readonly scale: number;
  readonly width: number;
  /** Where chosen keyframes are while the pointer holds them. */
  readonly retiming: ((songTime: number) => number) | null;
}

/** Nearer than this, two keyframes that are not chosen are one mark. */
const LEAST_GAP = 2;

/** Draw one row's keyframes: only those on screen. */
export function drawKeys(context: CanvasRenderingContext2D, view: KeysView, row: KeyRow): void {
  const { times, chosen } = row;
  const reach = (DIAMOND + 2) / view.scale;
  const first = firstFrom(times, view.from - reach);
  const beyond = firstFrom(times, view.from + view.width / view.scale + reach);
  context.globalAlpha = row.silent ? 0.38 : 1;
  if (!row.small) drawLine(context, view, row);
  drawPlain(context, view, row, first, beyond);
  if (chosen !== null) {
    if (view.retiming === null) drawChosen(context, view, row, first, beyond);
    else drawChosen(context, view, row, 0, times.length);
  }
  context.globalAlpha = 1;
}

/** From the first keyframe to the last the track is in the show's hand. */
function drawLine(context: CanvasRenderingContext2D, view: KeysView, { times, y }: KeyRow): void {
  const [first, last] = [times[0], times.at(-1)];
  if (first === undefined || last === undefined) return;
  const from = Math.max((first - view.from) * view.scale, 0);
  const to = Math.min((last - view.from) * view.scale, view.width);
  context.fillStyle = INK.bar;
  if (to > from) context.fillRect(from, y - 0.5, to - from, 1);
}

function drawPlain(context: CanvasRenderingContext2D, view: KeysView, row: KeyRow, first: number, beyond: number): void {
  const { track, times, chosen, isColor, y } = row;
  const size = row.small ? DIAMOND - 2 : DIAMOND;
  let drawnTo = -Infinity;
  context.beginPath();
  context.fillStyle = row.small ? INK.faint : INK.paper;
  for (let index = first; index < beyond; index += 1) {
    const x = ((times[index] ?? 0) - view.from) * view.scale;
    if (x - drawnTo < LEAST_GAP) continue;
    const keyframe = track.keyframes[index];
    if (keyframe === undefined || chosen?.has(keyframe.key) === true) continue;
    drawnTo = x;
    if (isColor && !row.small) {
      outline(context, x, y, size, keyframe.interpolation, hexOf(keyframe.value));
      continue;
    }
    shape(context, x, y, size, keyframe.interpolation);
  }
  if (!isColor || row.small) context.fill();
}

function drawChosen(context: CanvasRenderingContext2D, view: KeysView, row: KeyRow, first: number, beyond: number): void {
  const { track, times, chosen, y } = row;
  const size = row.small ? DIAMOND - 1.5 : DIAMOND + 1;
  context.beginPath();
  let drawnTo = -Infinity;
  for (let index = first; index < beyond; index += 1) {
    const keyframe = track.keyframes[index];
    if (keyframe === undefined || chosen?.has(keyframe.key) !== true) continue;
    const time = times[index] ?? 0;
    const x = ((view.retiming === null ? time : view.retiming(time)) - view.from) * view.scale;
    if (x < -size || x > view.width + size || Math.abs(x - drawnTo) < 1) continue;
    drawnTo = x;
    shape(context, x, y, size, keyframe.interpolation);
  }
  context.fillStyle = INK.brass;
  context.fill();
  context.lineWidth = 1.5;
  context.strokeStyle = INK.paper;
  context.stroke();
}

function outline(
  context: CanvasRenderingContext2D,
  x: number,
  y: number,
  size: number,
  way: string | undefined,
  color: string,
): void {
  context.beginPath();
  shape(context, x, y, size, way);
  context.fillStyle = color;
  context.fill();
  context.lineWidth = 1.25;
  context.strokeStyle = INK.paper;
  context.stroke();
}

/** A diamond; a square where the value jumps there. */
function shape(context: CanvasRenderingContext2D, x: number, y: number, size: number, way: string | undefined): void {
  if (way === "step") {
    const half = size * 0.8;
    context.rect(x - half, y - half, 2 * half, 2 * half);
    return;
  }
  context.moveTo(x, y - size);
  context.lineTo(x + size, y);
  context.lineTo(x, y + size);
  context.lineTo(x - size, y);
  context.closePath();
}
