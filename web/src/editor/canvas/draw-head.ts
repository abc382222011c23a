import type { Score, WireNote } from "../../generated/protocol";
import { pitchRange } from "../../state/overview";
import { clockTime } from "../../state/readout";
import type { LoopSpan } from "../../timeline/loop-span";
import type { Peaks } from "../../timeline/peaks";
import type { TimeAxis } from "../state/time-axis";
import { gridLines, timeStep } from "./grid";
import { font, INK } from "./ink";
import { headHeight, type Layout } from "./layout";

/** Width of a loop's ends, pixels; they stand outside of it. */
const LOOP_GRIP = 5;

/** What stands still while keyframes are moved. */
export interface Ground {
  readonly layout: Layout;
  readonly width: number;
  readonly height: number;
  readonly from: number;
  readonly scale: number;
  readonly duration: number;
  readonly score: Score;
  readonly axis: TimeAxis;
  readonly notes: readonly WireNote[];
  readonly peaks: Peaks | null;
  readonly loop: LoopSpan | null;
  readonly markers: readonly { readonly time: number; readonly name: string; readonly chosen: boolean }[];
  /** The rows' stripes: y of their upper edge. */
  readonly rows: readonly { readonly y: number; readonly group: boolean; readonly active: boolean }[];
}

/** Draw ruler, markers, waveform, notes and the grid behind the rows. */
export function drawGround(context: CanvasRenderingContext2D, ground: Ground): void {
  drawRows(context, ground);
  drawGrid(context, ground);
  drawMusic(context, ground);
  drawMarkers(context, ground);
  drawEnd(context, ground);
}

function xOf({ from, scale }: Ground, time: number): number {
  return (time - from) * scale;
}

function drawRows(context: CanvasRenderingContext2D, ground: Ground): void {
  const { layout, width, height } = ground;
  const head = headHeight(layout);
  context.save();
  context.beginPath();
  context.rect(0, head, width, height - head);
  context.clip();
  for (const { y, group, active } of ground.rows) {
    if (active || group) {
      context.fillStyle = active ? INK.active : INK.stripe;
      context.fillRect(0, y, width, layout.row);
    }
    context.fillStyle = INK.line;
    context.fillRect(0, y + layout.row - 1, width, 1);
  }
  context.restore();
}

function drawGrid(context: CanvasRenderingContext2D, ground: Ground): void {
  const { layout, width, height, scale, from } = ground;
  const to = from + width / scale;
  context.fillStyle = INK.stripe;
  context.fillRect(0, 0, width, layout.loop);
  if (ground.loop !== null) drawLoop(context, ground, ground.loop);
  context.textBaseline = "alphabetic";
  for (const { time, bar, isBar } of gridLines(ground.score, ground.axis, from, to, scale)) {
    const x = Math.round(xOf(ground, time));
    context.fillStyle = isBar ? INK.bar : INK.line;
    const top = bar === null ? layout.ruler - (isBar ? 7 : 4) : 4;
    context.fillRect(x, top, 1, height - top);
    if (bar === null) continue;
    context.fillStyle = INK.soft;
    context.font = font(11.5, 600);
    context.fillText(String(bar), x + 5, layout.loop - 3);
  }
  context.fillStyle = INK.faint;
  context.font = font(9.5);
  const step = timeStep(scale);
  for (let at = Math.ceil(Math.max(from, 0) / step) * step; at <= to; at += step) {
    const x = xOf(ground, at);
    context.fillText(clockTime(at + 1e-6, step < 1), x + 4, layout.ruler - 4);
    context.fillRect(Math.round(x), layout.ruler - 3, 1, 3);
  }
  context.fillStyle = INK.bar;
  context.fillRect(0, layout.ruler - 1, width, 1);
  context.fillRect(0, headHeight(layout) - 1, width, 1);
}

/** The loop: a wash over all, a bar along the bar numbers that is taken to move it, and its two ends. */
function drawLoop(context: CanvasRenderingContext2D, ground: Ground, { start, end }: LoopSpan): void {
  const { layout, height } = ground;
  const [from, to] = [xOf(ground, start), xOf(ground, end)];
  context.fillStyle = INK.brassWash;
  context.fillRect(from, 0, to - from, height);
  context.fillStyle = INK.loop;
  context.fillRect(from, 1, to - from, layout.loop - 2);
  context.fillStyle = INK.brass;
  for (const x of [from - LOOP_GRIP, to]) {
    context.beginPath();
    context.roundRect(x, 1, LOOP_GRIP, layout.loop - 2, 2);
    context.fill();
  }
}

function drawMusic(context: CanvasRenderingContext2D, ground: Ground): void {
  const { layout, width, scale, from, notes, peaks } = ground;
  const top = layout.ruler + layout.markers;
  const room = layout.music;
  if (peaks !== null) drawWave(context, ground, peaks, top, room);
  const [low, high] = pitchRange(notes);
  const to = from + width / scale;
  context.fillStyle = INK.light;
  for (const note of notes) {
    if (note.onset_s > to) break;
    if (note.onset_s + note.duration_s < from) continue;
    const x = xOf(ground, note.onset_s);
    const y = top + 3 + (1 - (note.sounding_pitch - low) / (high - low)) * (room - 9);
    context.fillRect(x, y, Math.max(note.duration_s * scale - 0.75, 1.5), 3);
  }
}

function drawWave(context: CanvasRenderingContext2D, ground: Ground, peaks: Peaks, top: number, room: number): void {
  const { width, from, scale } = ground;
  const middle = top + room / 2;
  const half = room / 2 - 1;
  context.fillStyle = INK.wave;
  for (let x = 0; x < width; x += 1) {
    const [low, high] = peaks.between(from + x / scale, from + (x + 1) / scale);
    if (high <= low) continue;
    context.fillRect(x, middle - high * half, 1, Math.max((high - low) * half, 0.75));
  }
}

function drawMarkers(context: CanvasRenderingContext2D, ground: Ground): void {
  const { layout, height, width } = ground;
  const top = layout.ruler;
  context.font = font(10.5);
  ground.markers.forEach(({ time, name, chosen }, index) => {
    const x = Math.round(xOf(ground, time));
    const next = ground.markers[index + 1];
    if (x > width || (next !== undefined && xOf(ground, next.time) < 0)) return;
    context.fillStyle = INK.brass;
    context.globalAlpha = chosen ? 1 : 0.6;
    context.fillRect(x, top, 1, height - top);
    context.globalAlpha = 1;
    const limit = (next === undefined ? width : xOf(ground, next.time)) - x - 6;
    const shown = Math.max(Math.min(context.measureText(name).width + 10, limit), 8);
    context.fillStyle = chosen ? INK.light : INK.brass;
    context.beginPath();
    context.roundRect(x, top + 2, shown, layout.markers - 4, [0, 4, 4, 0]);
    context.fill();
    context.save();
    context.clip();
    context.fillStyle = INK.ink;
    context.fillText(name, x + 5, top + layout.markers - 6);
    context.restore();
  });
}

/** Behind the last note there is nothing to see. */
function drawEnd(context: CanvasRenderingContext2D, ground: Ground): void {
  const { width, height } = ground;
  context.fillStyle = "rgb(8 9 13 / 0.34)";
  const end = xOf(ground, ground.duration);
  if (end < width) context.fillRect(end, 0, width - end, height);
  const begin = xOf(ground, 0);
  if (begin > 0) context.fillRect(0, 0, begin, height);
}
