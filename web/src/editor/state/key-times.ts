import type { ShowTrack, TimeUnit } from "./show-document";
import type { TimeAxis } from "./time-axis";

/** Song times of tracks' keyframes, seconds, in their order; reckoned once for each state of a track. */
export class KeyTimes {
  readonly #axis: TimeAxis;
  readonly #unit: TimeUnit;
  readonly #known = new WeakMap<ShowTrack, Float64Array>();

  /** @param unit of tracks that name none. */
  constructor(axis: TimeAxis, unit: TimeUnit) {
    this.#axis = axis;
    this.#unit = unit;
  }

  unitOf(track: ShowTrack): TimeUnit {
    return track.time ?? this.#unit;
  }

  of(track: ShowTrack): Float64Array {
    const known = this.#known.get(track);
    if (known !== undefined) return known;
    const unit = this.unitOf(track);
    const times = new Float64Array(track.keyframes.length);
    for (let index = 0; index < times.length; index += 1) {
      times[index] = this.#axis.toSongTime(unit, track.keyframes[index]?.time ?? 0);
    }
    this.#known.set(track, times);
    return times;
  }
}

/** Index of the first time that is not before `time`; their number where all are. */
export function firstFrom(times: Float64Array, time: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? Infinity) < time) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Index of the time nearest to `time`; -1 where there is none. */
export function nearest(times: Float64Array, time: number): number {
  const after = firstFrom(times, time);
  const before = after - 1;
  if (before < 0) return after < times.length ? after : -1;
  if (after >= times.length) return before;
  return (times[after] ?? Infinity) - time < time - (times[before] ?? -Infinity) ? after : before;
}
