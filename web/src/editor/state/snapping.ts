import type { Score } from "../../generated/protocol";
import type { TimeAxis } from "./time-axis";

export const SNAPS = ["bars", "beats", "keys", "markers", "frames"] as const;
export type Snap = (typeof SNAPS)[number];

/** Places that a time may be drawn to. */
export interface SnapPlaces {
  readonly axis: TimeAxis;
  readonly score: Pick<Score, "bar_lines_s">;
  /** Song times of keyframes that stay, seconds. */
  readonly keys: readonly Float64Array[];
  readonly markers: readonly number[];
  readonly fps: number;
}

/**
 * The place that a song time is drawn to: the nearest of those that are on, where one is near enough.
 *
 * Between two beats there are places too, once a beat is so wide on screen that they are apart.
 *
 * @param reach how near is near enough, seconds.
 */
export function snapped(time: number, reach: number, on: ReadonlySet<Snap>, places: SnapPlaces): number {
  let best = time;
  let distance = reach;
  const consider = (place: number): void => {
    const away = Math.abs(place - time);
    if (away < distance) [best, distance] = [place, away];
  };
  const { axis, score, fps } = places;
  if (on.has("markers")) places.markers.forEach(consider);
  if (on.has("keys")) for (const times of places.keys) considerNearest(times, time, consider);
  if (on.has("bars")) considerNearest(score.bar_lines_s, time, consider);
  if (on.has("beats")) {
    const beats = axis.beatsAt(time);
    const part = partOfBeat(axis.secondsAt(beats + 1) - time, reach);
    consider(axis.secondsAt(Math.round(beats / part) * part));
  }
  // Frames are so close that they would win over everything; they count where nothing else does.
  if (on.has("frames") && best === time) consider(Math.round(time * fps) / fps);
  return best;
}

/** The finest of whole, half, quarter and eighth beats that stay apart at this zoom. */
function partOfBeat(beat: number, reach: number): number {
  return [1 / 8, 1 / 4, 1 / 2].find((part) => beat * part > 4 * reach) ?? 1;
}

function considerNearest(times: ArrayLike<number>, time: number, consider: (place: number) => void): void {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? Infinity) < time) low = middle + 1;
    else high = middle;
  }
  for (const index of [low - 1, low]) {
    const place = times[index];
    if (place !== undefined) consider(place);
  }
}
