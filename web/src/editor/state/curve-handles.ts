import type { ShowParameter } from "../../generated/protocol";
import { componentsOf } from "./component-values";
import type { Edit } from "./edits";
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
    if (next.interpolation === "cubic_spline" && parameter.type !== "color")
      return slopeHandles(parameter, previous, next);
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

/** A slope is drawn as the Bézier handle that it is in a cubic: a third of the way. */
function slopeHandles(parameter: ShowParameter, previous: ShowKeyframe, next: ShowKeyframe): Handle[] {
  const third = (next.time - previous.time) / 3;
  const [begins, ends] = [componentsOf(parameter, previous.value), componentsOf(parameter, next.value)];
  return begins.flatMap((from, component): Handle[] => {
    const to = ends[component] ?? 0;
    const out = slopeOf(previous.out_tangent, component);
    const into = slopeOf(next.in_tangent, component);
    return [
      {
        kind: "out",
        key: previous.key,
        component,
        time: previous.time + third,
        value: from + out * third,
        at: { time: previous.time, value: from },
      },
      {
        kind: "in",
        key: next.key,
        component,
        time: next.time - third,
        value: to - into * third,
        at: { time: next.time, value: to },
      },
    ];
  });
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
    const slope = tidy((value - handle.at.value) / away);
    const name = handle.kind === "out" ? "out_tangent" : "in_tangent";
    if (parameter.type === "number") return change({ [name]: slope });
    const slopes = componentsOf(parameter, keyframe.value).map((_, each) =>
      each === handle.component ? slope : slopeOf(keyframe[name], each),
    );
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
