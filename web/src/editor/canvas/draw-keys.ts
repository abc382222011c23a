import { firstFrom } from "../state/key-times";
import { hexOf } from "../state/parameter-value";
import { cutSideOf, type CutSide } from "../state/shots";
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
}

/** Where a keyframe is drawn whose song time this is. */
type Placing = (songTime: number) => number;

/** Nearer to each other than this, keyframes are one band: their marks would be one anyway. */
const DENSE = 3.5;

/** Draw a row's keyframes that are not chosen: only those on screen. */
export function drawPlainKeys(context: CanvasRenderingContext2D, view: KeysView, row: KeyRow): void {
  context.globalAlpha = row.silent ? 0.4 : 1;
  if (!row.small) drawLine(context, view, row);
  const flags = row.chosen === null ? null : chosenFlags(row.track, row.chosen);
  const [first, beyond] = onScreen(view, row);
  const size = row.small ? DIAMOND - 2 : DIAMOND;
  context.fillStyle = row.small ? INK.faint : INK.paper;
  drawMarks(context, view, row, size, first, beyond, (index) => flags?.[index] !== 1);
  context.globalAlpha = 1;
}

/** Draw a row's chosen keyframes, where `placing` takes them; null where they rest. */
export function drawChosenKeys(
  context: CanvasRenderingContext2D,
  view: KeysView,
  row: KeyRow,
  placing: Placing | null,
): void {
  if (row.chosen === null) return;
  const flags = chosenFlags(row.track, row.chosen);
  // What is moved may come from outside of the screen.
  const [first, beyond] = placing === null ? onScreen(view, row) : [0, row.times.length];
  context.fillStyle = INK.brass;
  context.strokeStyle = INK.paper;
  context.lineWidth = 1.5;
  const size = row.small ? DIAMOND - 1.5 : DIAMOND + 1;
  drawMarks(
    context,
    view,
    { ...row, isColor: false },
    size,
    first,
    beyond,
    (index) => flags[index] === 1,
    placing,
    true,
  );
}

function drawMarks(
  context: CanvasRenderingContext2D,
  view: KeysView,
  { track, times, isColor, small, y }: KeyRow,
  size: number,
  first: number,
  beyond: number,
  counts: (index: number) => boolean,
  placing: Placing | null = null,
  outlined = false,
): void {
  /** The band that is open: where it began, where it has come to, and its first keyframe. */
  let [begin, end, opened] = [-Infinity, -Infinity, -1];
  const close = (): void => {
    if (opened < 0) return;
    const keyframe = track.keyframes[opened];
    const side = small ? null : cutSideOf(track, times, opened);
    if (end - begin > DENSE) context.rect(begin - size * 0.7, y - size * 0.7, end - begin + size * 1.4, size * 1.4);
    else if (isColor && !small) outline(context, begin, y, size, side, keyframe?.interpolation, hexOf(keyframe?.value));
    else shape(context, begin, y, size, side, keyframe?.interpolation);
  };
  context.beginPath();
  for (let index = first; index < beyond; index += 1) {
    if (!counts(index)) continue;
    const time = times[index] ?? 0;
    const x = ((placing === null ? time : placing(time)) - view.from) * view.scale;
    if (x < -size || x > view.width + size) continue;
    // However near, the two sides of a cut are told apart: their marks point away from each other.
    const cuts = index === opened + 1 && !small && cutSideOf(track, times, index) === "begin";
    if (x - end < DENSE && !cuts) {
      end = x;
      continue;
    }
    close();
    [begin, end, opened] = [x, x, index];
  }
  close();
  context.fill();
  if (outlined) context.stroke();
}

function onScreen(view: KeysView, { times }: KeyRow): readonly [number, number] {
  const reach = (DIAMOND + 2) / view.scale;
  return [firstFrom(times, view.from - reach), firstFrom(times, view.from + view.width / view.scale + reach)];
}

const flagged = new WeakMap<ShowTrack, { readonly chosen: ReadonlySet<string>; readonly flags: Uint8Array }>();

/** Which keyframes of a track are chosen, 0 or 1; looked up once for a track and a choice. */
function chosenFlags(track: ShowTrack, chosen: ReadonlySet<string>): Uint8Array {
  const known = flagged.get(track);
  if (known?.chosen === chosen) return known.flags;
  const flags = Uint8Array.from(track.keyframes, ({ key }) => Number(chosen.has(key)));
  flagged.set(track, { chosen, flags });
  return flags;
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

function outline(
  context: CanvasRenderingContext2D,
  x: number,
  y: number,
  size: number,
  side: CutSide,
  way: string | undefined,
  color: string,
): void {
  const before = context.fillStyle;
  context.beginPath();
  shape(context, x, y, size, side, way);
  context.fillStyle = color;
  context.fill();
  context.lineWidth = 1.25;
  context.strokeStyle = INK.paper;
  context.stroke();
  context.fillStyle = before;
  context.beginPath();
}

/** A diamond; a square where the value jumps there. Of a cut the end is a diamond's left half, the beginning a square's right. */
function shape(
  context: CanvasRenderingContext2D,
  x: number,
  y: number,
  size: number,
  side: CutSide,
  way: string | undefined,
): void {
  const half = size * 0.8;
  if (side === "begin") {
    context.rect(x, y - size, half, 2 * size);
    return;
  }
  if (way === "step") {
    context.rect(x - half, y - half, 2 * half, 2 * half);
    return;
  }
  context.moveTo(x, y - size);
  if (side === null) context.lineTo(x + size, y);
  context.lineTo(x, y + size);
  context.lineTo(x - size, y);
  context.closePath();
}
