import type { AlignedBar } from "../generated/protocol";
import type { Peaks } from "../timeline/peaks";
import { anchorAt, lineOf, type Corrections } from "./corrections";
import { UNSURE } from "./facts";

/** A recording with the score's bar lines in it, and how large, in CSS pixels. */
export interface RecordingPicture {
  readonly peaks: Peaks | null;
  readonly bars: readonly AlignedBar[];
  /** Where each bar line is, seconds of the recording. */
  readonly lines: readonly number[];
  readonly corrections: Corrections;
  /** Whether something was found, so that a bar may be unsure. */
  readonly isFound: boolean;
  /** The bar that is chosen, a place in `bars`. */
  readonly chosen: number | null;
  /** Song time at the left edge, seconds, and pixels a second. */
  readonly from: number;
  readonly scale: number;
  readonly width: number;
  readonly height: number;
}

/** Height of the bars' numbers below the recording, where their lines are taken hold of, pixels. */
export const HOLD = 26;
/** Room that a bar's number takes, pixels. */
const NUMBER_GAP = 30;

const WAVE = "rgb(244 239 230 / 0.5)";
const LINE = "rgb(244 239 230 / 0.62)";
const UNSURE_LINE = "rgb(244 239 230 / 0.85)";
const ANCHOR = "#e8bf6e";
const NUMBER = "rgb(244 239 230 / 0.86)";

/** Every so many bars have a number, so that numbers do not lie over each other. */
export function numberStep(lines: readonly number[], scale: number): number {
  const [first = 0, last = 0] = [lines[0], lines.at(-1)];
  const gap = ((last - first) / Math.max(lines.length - 1, 1)) * scale;
  return [1, 2, 4, 8, 16, 32, 64, 128].find((step) => step * gap >= NUMBER_GAP) ?? 256;
}

/** Draw what is on screen: the sound above, the bars below; dashed where it is not sure, brass where it was put. */
export function drawRecording(context: CanvasRenderingContext2D, picture: RecordingPicture): void {
  const { width, height } = picture;
  context.clearRect(0, 0, width, height);
  drawWave(context, picture);
  drawBars(context, picture);
}

function drawWave(context: CanvasRenderingContext2D, { peaks, from, scale, width, height }: RecordingPicture): void {
  if (peaks === null) return;
  const half = (height - HOLD) / 2 - 2;
  context.fillStyle = WAVE;
  for (let x = 0; x < width; x += 1) {
    const [low, high] = peaks.between(from + x / scale, from + (x + 1) / scale);
    if (high <= low) continue;
    context.fillRect(x, half + 2 - high * half, 1, Math.max((high - low) * half, 0.75));
  }
}

function drawBars(context: CanvasRenderingContext2D, picture: RecordingPicture): void {
  const { bars, lines, corrections, isFound, chosen, from, scale, width, height } = picture;
  const step = numberStep(lines, scale);
  context.font = `500 11px "Instrument Sans", system-ui, sans-serif`;
  context.textBaseline = "middle";
  context.textAlign = "center";
  let free = -Infinity;
  bars.forEach((bar, index) => {
    const x = ((lines[index] ?? 0) - from) * scale;
    if (x < -NUMBER_GAP || x > width + NUMBER_GAP) return;
    const anchored = anchorAt(corrections, lineOf(bar)?.score_s ?? -1) !== null;
    if (!bar.is_heard && !anchored) return;
    const unsure = isFound && !anchored && bar.confidence < UNSURE;
    const numbered = index === chosen || anchored || (index % step === 0 && x - free >= NUMBER_GAP * 0.8);
    context.strokeStyle = anchored ? ANCHOR : unsure ? UNSURE_LINE : LINE;
    context.lineWidth = index === chosen ? 2 : 1;
    context.setLineDash(unsure ? [3, 4] : []);
    context.beginPath();
    context.moveTo(Math.round(x) + 0.5, numbered ? 0 : height - HOLD - 8);
    context.lineTo(Math.round(x) + 0.5, height - HOLD);
    context.stroke();
    context.setLineDash([]);
    if (anchored) drawAnchor(context, x, height - HOLD);
    if (!numbered || (x - free < NUMBER_GAP * 0.8 && index !== chosen)) return;
    free = x;
    if (index === chosen) {
      context.fillStyle = "rgb(244 239 230 / 0.16)";
      context.beginPath();
      context.roundRect(x - 14, height - HOLD + 6, 28, HOLD - 7, 6);
      context.fill();
    }
    context.fillStyle = anchored ? ANCHOR : NUMBER;
    context.fillText(unsure ? `${bar.number}?` : `${bar.number}`, x, height - HOLD / 2 + 3);
  });
}

/** A diamond, as keyframes have it: this place is held. */
function drawAnchor(context: CanvasRenderingContext2D, x: number, y: number): void {
  context.fillStyle = ANCHOR;
  context.beginPath();
  context.moveTo(x, y - 6);
  context.lineTo(x + 5, y);
  context.lineTo(x, y + 6);
  context.lineTo(x - 5, y);
  context.fill();
}
