import type { ShowParameter } from "../../generated/protocol";
import { componentsOf } from "./component-values";
import type { Edit } from "./edits";
import { mixingSpaceOf, type Triple } from "./mixing-space";
import type { ShowKeyframe, ShowTrack } from "./show-document";

/** CSS's `ease`: what a cubic Bézier has where its key names no handles. */
const USUAL: readonly number[] = [0.25, 0.1, 0.25, 1];
const LEAST = 1e-9;

/** Something that can be taken to bend a curve. Times are in the track's unit. */
export interface Handle {
  readonly kind: "start" | "end" | "out" | "in";
  /** The key whose field it is. */
  readonly key: string;
  readonly component: number;
  readonly time: number;
  readonly value: number;
  /** The keyframe that it hangs on. */
  readonly at: { readonly time: number; readonly value: number };
}

/** The handles of the segments before and after chosen keyframes: where they are is given by the keys' own numbers. */
export function handlesOf(track: ShowTrack, parameter: ShowParameter, chosen: ReadonlySet<string>): Handle[] {
  return track.keyframes.flatMap((next, index) => {
    const previous = track.keyframes[index - 1];
    if (previous === undefined || !(chosen.has(previous.key) || chosen.has(next.key))) return [];
    if (next.interpolation === "cubic_bezier") return bezierHandles(parameter, previous, next);
    if (next.interpolation === "cubic_spline") return slopeHandles(track, parameter, previous, next);
    return [];
  });
}

function bezierHandles(parameter: ShowParameter, previous: ShowKeyframe, next: ShowKeyframe): Handle[] {
  const [x1 = 0, y1 = 0, x2 = 1, y2 = 1] = next.handles ?? USUAL;
  const { component, from, to } = steepest(parameter, previous, next);
  const length = next.time - previous.time;
  const place = (x: number, y: number) => ({ time: previous.time + x * length, value: from + y * (to - from) });
  return [
    { kind: "start", key: next.key, component, ...place(x1, y1), at: { time: previous.time, value: from } },
    { kind: "end", key: next.key, component, ...place(x2, y2), at: { time: next.time, value: to } },
  ];
}

/**
 * A slope is drawn as the Bézier handle that it is in a cubic: a third of the way, each component by itself.
 *
 * A colour's slopes are told in the space that it is mixed in: its handles stand where the Bézier's points are there.
 */
function slopeHandles(
  track: ShowTrack,
  parameter: ShowParameter,
  previous: ShowKeyframe,
  next: ShowKeyframe,
): Handle[] {
  const third = (next.time - previous.time) / 3;
  const begins = componentsOf(parameter, previous.value);
  const ends = componentsOf(parameter, next.value);
  const out = alongSlope(track, parameter, previous, "out_tangent", third);
  const into = alongSlope(track, parameter, next, "in_tangent", -third);
  return begins.flatMap((from, component): Handle[] => [
    {
      kind: "out",
      key: previous.key,
      component,
      time: previous.time + third,
      value: out[component] ?? from,
      at: { time: previous.time, value: from },
    },
    {
      kind: "in",
      key: next.key,
      component,
      time: next.time - third,
      value: into[component] ?? 0,
      at: { time: next.time, value: ends[component] ?? 0 },
    },
  ]);
}

/** Where a key's slope leads in so much time, as the components of a curve. */
function alongSlope(
  track: ShowTrack,
  parameter: ShowParameter,
  keyframe: ShowKeyframe,
  name: "in_tangent" | "out_tangent",
  away: number,
): readonly number[] {
  const from = componentsOf(parameter, keyframe.value);
  if (parameter.type !== "color") return from.map((each, index) => each + slopeOf(keyframe[name], index) * away);
  const space = mixingSpaceOf(track);
  const [a, b, c] = space.to(triple(from));
  return space.from([
    a + slopeOf(keyframe[name], 0) * away,
    b + slopeOf(keyframe[name], 1) * away,
    c + slopeOf(keyframe[name], 2) * away,
  ]);
}

/** The slope that leads a key to some components in so much time. */
function slopesTo(
  track: ShowTrack,
  parameter: ShowParameter,
  keyframe: ShowKeyframe,
  wanted: readonly number[],
  away: number,
): number[] {
  const from = componentsOf(parameter, keyframe.value);
  if (parameter.type !== "color") return wanted.map((each, index) => tidy((each - (from[index] ?? 0)) / away));
  const space = mixingSpaceOf(track);
  const begin = space.to(triple(from));
  return space.to(triple(wanted)).map((each, index) => tidy((each - (begin[index] ?? 0)) / away));
}

function triple([a = 0, b = 0, c = 0]: readonly number[]): Triple {
  return [a, b, c];
}

/** The edit that takes a handle to another place; null where it cannot go there. */
export function handleEdit(
  track: ShowTrack,
  parameter: ShowParameter,
  handle: Handle,
  time: number,
  value: number,
): Edit | null {
  const index = track.keyframes.findIndex(({ key }) => key === handle.key);
  const keyframe = track.keyframes[index];
  if (keyframe === undefined) return null;
  const change = (changes: Record<string, unknown>): Edit => ({
    edit: "change_keyframe",
    parameter: track.parameter,
    key: handle.key,
    changes,
  });
  if (handle.kind === "out" || handle.kind === "in") {
    const away = time - handle.at.time;
    if (Math.abs(away) < LEAST || away > 0 !== (handle.kind === "out")) return null;
    const name = handle.kind === "out" ? "out_tangent" : "in_tangent";
    // The other components keep the way they go.
    const wanted = alongSlope(track, parameter, keyframe, name, away).map((each, component) =>
      component === handle.component ? value : each,
    );
    const slopes = slopesTo(track, parameter, keyframe, wanted, away);
    if (parameter.type === "number") return change({ [name]: slopes[0] ?? 0 });
    return change({ [name]: slopes });
  }
  const previous = track.keyframes[index - 1];
  if (previous === undefined) return null;
  const { from, to } = steepest(parameter, previous, keyframe);
  const place = handle.kind === "start" ? 0 : 2;
  const handles = [...(keyframe.handles ?? USUAL)];
  handles[place] = tidy(Math.min(Math.max((time - previous.time) / (keyframe.time - previous.time), 0), 1));
  if (Math.abs(to - from) > LEAST)
    handles[place + 1] = tidy(Math.min(Math.max((value - from) / (to - from), -100), 100));
  return change({ handles });
}

/** All components of a Bézier keep one pace: its handles are shown on the one that goes furthest. */
function steepest(
  parameter: ShowParameter,
  previous: ShowKeyframe,
  next: ShowKeyframe,
): { component: number; from: number; to: number } {
  const [begins, ends] = [componentsOf(parameter, previous.value), componentsOf(parameter, next.value)];
  const ways = begins.map((from, index) => Math.abs((ends[index] ?? 0) - from));
  const component = Math.max(ways.indexOf(Math.max(...ways)), 0);
  return { component, from: begins[component] ?? 0, to: ends[component] ?? 0 };
}

function slopeOf(tangent: number | readonly number[] | undefined, component: number): number {
  return typeof tangent === "object" ? (tangent[component] ?? 0) : (tangent ?? 0);
}

function tidy(value: number): number {
  return Number(value.toFixed(4));
}
