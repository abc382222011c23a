import type { ShowKeyframe, TimeUnit } from "./show-document";
import { placed, type Retiming } from "./spans";
import type { TimeAxis } from "./time-axis";

/** Nearer to each other than this, in their track's unit, two keyframes stand at one time. */
const SAME_TIME = 1e-6;

/** A track's keyframes with some of them moved: what stands where one comes to makes room, and slopes are stretched along. */
export function retimedKeyframes(
  axis: TimeAxis,
  unit: TimeUnit,
  keyframes: readonly ShowKeyframe[],
  keys: ReadonlySet<string>,
  retiming: Retiming,
): ShowKeyframe[] {
  const moved = keyframes.filter(({ key }) => keys.has(key)).map((keyframe) => retimed(axis, unit, keyframe, retiming));
  const taken = moved.map(({ time }) => time).sort((a, b) => a - b);
  const stays = keyframes.filter(({ key, time }) => !keys.has(key) && !standsAt(taken, time));
  return [...stays, ...moved];
}

function retimed(axis: TimeAxis, unit: TimeUnit, keyframe: ShowKeyframe, retiming: Retiming): ShowKeyframe {
  const time = axis.toTrackTime(unit, placed(axis, retiming, axis.toSongTime(unit, keyframe.time)));
  const slopes = retiming.factor === 1 ? [] : (["in_tangent", "out_tangent"] as const);
  const stretched = slopes.flatMap((name) => {
    const slope = keyframe[name];
    if (slope === undefined) return [];
    return [
      [
        name,
        typeof slope === "number" ? slope / retiming.factor : slope.map((part) => part / retiming.factor),
      ] as const,
    ];
  });
  return { ...keyframe, time, ...Object.fromEntries(stretched) };
}

function standsAt(times: readonly number[], time: number): boolean {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? Infinity) < time - SAME_TIME) low = middle + 1;
    else high = middle;
  }
  return Math.abs((times[low] ?? Infinity) - time) <= SAME_TIME;
}
