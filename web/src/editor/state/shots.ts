import { firstFrom, nearest } from "./key-times";
import { groupOf } from "./rows";
import type { ShowTrack } from "./show-document";

/** A key right before a jump ends what was shown until then: nearer than this, seconds, the two are one cut. */
const ONE_CUT_S = 0.15;
/** Keys of several tracks at one time, seconds. */
const TOGETHER_S = 1e-4;
/** The camera cuts where one of these jumps. */
const CUTTING = ["camera/position", "camera/target"];
export const CAMERA_GROUP = "camera";

/** Song times of a track's keyframes, seconds. */
export type TimesOf = (track: ShowTrack) => Float64Array;

/** A camera's shot: from one cut to the next, song times, seconds. */
export interface Shot {
  readonly start: number;
  readonly end: number;
}

/** What a keyframe is of a cut: what ends before it, what begins with it, or nothing. */
export type CutSide = "end" | "begin" | null;

/** @param times of the track, seconds */
export function cutSideOf({ keyframes }: ShowTrack, times: Float64Array, index: number): CutSide {
  const isCut = (at: number): boolean =>
    at > 0 &&
    keyframes[at]?.interpolation === "step" &&
    keyframes[at - 1]?.interpolation !== "step" &&
    (times[at] ?? 0) - (times[at - 1] ?? 0) <= ONE_CUT_S;
  if (isCut(index)) return "begin";
  return index + 1 < keyframes.length && isCut(index + 1) ? "end" : null;
}

/**
 * Chosen keyframes with those that move with them: both sides of a cut, and what else the camera does in it.
 *
 * @param tracks of the show
 * @param chosen keys by track
 */
export function withCuts(
  tracks: readonly ShowTrack[],
  timesOf: TimesOf,
  chosen: ReadonlyMap<string, ReadonlySet<string>>,
): ReadonlyMap<string, ReadonlySet<string>> {
  const carried = new Map([...chosen].map(([path, keys]) => [path, new Set(keys)]));
  const camera = tracks.filter(({ parameter }) => groupOf(parameter) === CAMERA_GROUP);
  const carry = (track: ShowTrack, index: number): void => {
    const side = cutSideOf(track, timesOf(track), index);
    const keys = carried.get(track.parameter) ?? new Set<string>();
    for (const each of [index, ...(side === null ? [] : [side === "begin" ? index - 1 : index + 1])]) {
      const key = track.keyframes[each]?.key;
      if (key !== undefined) keys.add(key);
    }
    carried.set(track.parameter, keys);
  };
  for (const track of tracks) {
    const keys = chosen.get(track.parameter);
    if (keys === undefined) continue;
    const times = timesOf(track);
    track.keyframes.forEach(({ key }, index) => {
      if (!keys.has(key)) return;
      carry(track, index);
      const cut = cutSideOf(track, times, index) === "end" ? index + 1 : index;
      if (!CUTTING.includes(track.parameter) || track.keyframes[cut]?.interpolation !== "step") return;
      for (const other of camera) {
        const there = keyAt(timesOf(other), times[cut] ?? 0);
        if (other.keyframes[there]?.interpolation === "step") carry(other, there);
      }
    });
  }
  return carried;
}

/** The camera's shots, where it cuts at all: each lasts to the next cut, the last to the music's end, seconds. */
export function shotsOf(tracks: readonly ShowTrack[], timesOf: TimesOf, duration: number): readonly Shot[] {
  const cuts = tracks
    .filter(({ parameter, muted }) => CUTTING.includes(parameter) && muted !== true)
    .flatMap((track) => {
      const times = timesOf(track);
      return track.keyframes.flatMap(({ interpolation }, index) =>
        index === 0 || interpolation === "step" ? [times[index] ?? 0] : [],
      );
    })
    .sort((a, b) => a - b)
    .filter((time, index, all) => index === 0 || time - (all[index - 1] ?? 0) > TOGETHER_S);
  if (cuts.length < 2) return [];
  return cuts.map((start, index) => ({ start, end: cuts[index + 1] ?? Math.max(duration, start) }));
}

/** The keys of the camera's tracks that stand in a shot. */
export function keysInShot(tracks: readonly ShowTrack[], timesOf: TimesOf, { start, end }: Shot): [string, string][] {
  return tracks
    .filter(({ parameter }) => groupOf(parameter) === CAMERA_GROUP)
    .flatMap((track) => {
      const times = timesOf(track);
      const [from, beyond] = [firstFrom(times, start - TOGETHER_S), firstFrom(times, end - TOGETHER_S)];
      return track.keyframes.slice(from, beyond).map(({ key }): [string, string] => [track.parameter, key]);
    });
}

function keyAt(times: Float64Array, time: number): number {
  const index = nearest(times, time);
  return Math.abs((times[index] ?? Infinity) - time) <= TOGETHER_S ? index : -1;
}
