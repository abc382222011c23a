import type { ShowKeyframe, TimeUnit } from "./show-document";
import { placed, type Retiming } from "./spans";
import type { TimeAxis } from "./time-axis";

/** Nearer to each other than this, in their track's unit, two keyframes stand at one time. */
const SAME_TIME = 1e-6;

/** Of a unit: over so much of the time the tempo at a keyframe is measured. */
const RATE_STEP = 1e-4;

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

/** A keyframe at the same place of the music in another unit, its slopes as steep as they were. */
export function inOtherUnit(axis: TimeAxis, unit: TimeUnit, other: TimeUnit, keyframe: ShowKeyframe): ShowKeyframe {
  const time = axis.toTrackTime(other, axis.toSongTime(unit, keyframe.time));
  const arriving = rateOf(axis, unit, other, keyframe.time, -1);
  const leaving = rateOf(axis, unit, other, keyframe.time, 1);
  return { ...keyframe, time, ...flatter(keyframe, { in_tangent: arriving, out_tangent: leaving }) };
}

/** How many of the other unit pass in one, at a time: just after it for way 1, before it for way -1. */
export function rateOf(axis: TimeAxis, unit: TimeUnit, other: TimeUnit, time: number, way: 1 | -1): number {
  const step = way * Math.max(RATE_STEP, 1e-7 * Math.abs(time));
  const from = axis.inUnit(other, axis.toSongTime(unit, time));
  return (axis.inUnit(other, axis.toSongTime(unit, time + step)) - from) / step;
}

/** The slopes that a keyframe has, each so many times flatter. */
function flatter(
  keyframe: ShowKeyframe,
  by: Readonly<Record<"in_tangent" | "out_tangent", number>>,
): Pick<ShowKeyframe, "in_tangent" | "out_tangent"> {
  const slopes = (["in_tangent", "out_tangent"] as const).flatMap((name) => {
    const slope = keyframe[name];
    if (slope === undefined) return [];
    return [[name, typeof slope === "number" ? slope / by[name] : slope.map((part) => part / by[name])] as const];
  });
  return Object.fromEntries(slopes);
}

function retimed(axis: TimeAxis, unit: TimeUnit, keyframe: ShowKeyframe, retiming: Retiming): ShowKeyframe {
  const time = axis.toTrackTime(unit, placed(axis, retiming, axis.toSongTime(unit, keyframe.time)));
  if (retiming.factor === 1) return { ...keyframe, time };
  return { ...keyframe, time, ...flatter(keyframe, { in_tangent: retiming.factor, out_tangent: retiming.factor }) };
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
