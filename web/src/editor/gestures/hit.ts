import { GRIP } from "../canvas/draw-span";
import { headHeight, type Layout } from "../canvas/layout";
import type { LoopPart } from "../../timeline/loop-span";
import type { Editor } from "../state/editor.svelte";
import { nearest } from "../state/key-times";
import type { Row } from "../state/rows";
import { CAMERA_GROUP } from "../state/shots";
import type { ShowTrack } from "../state/show-document";

export type KeyName = readonly [path: string, key: string];

/** What lies under a point of the timeline. */
export type Hit =
  | { readonly kind: "ruler" }
  | { readonly kind: "loop"; readonly part: LoopPart }
  | { readonly kind: "marker"; readonly index: number }
  | { readonly kind: "span" }
  | { readonly kind: "grip"; readonly side: "start" | "end" }
  | { readonly kind: "key"; readonly keys: readonly KeyName[]; readonly time: number; readonly row: Row }
  | { readonly kind: "shot"; readonly index: number }
  | { readonly kind: "row"; readonly row: Row | null };

/** Same time in a group's row, seconds. */
const TOGETHER_S = 1e-4;

/** @param reach how far from a key's middle it can be taken, pixels. */
export function hitAt(editor: Editor, layout: Layout, x: number, y: number, reach: number): Hit {
  const musicTop = layout.ruler + layout.markers;
  const head = headHeight(layout);
  if (y < layout.loop) return { kind: "loop", part: loopPartAt(editor, x, reach) };
  if (y < head - layout.span) {
    if (y >= layout.ruler && y < musicTop) {
      const index = markerAt(editor, x);
      if (index !== null) return { kind: "marker", index };
    }
    return { kind: "ruler" };
  }
  if (y < head) return hitSpan(editor, x, reach) ?? { kind: "row", row: null };
  if (editor.mode === "curves") return { kind: "row", row: null };
  const row = editor.rows[Math.floor((y - head + editor.scrollTop) / layout.row)] ?? null;
  return (row === null ? null : (hitKeys(editor, row, x, reach) ?? hitShot(editor, row, x))) ?? { kind: "row", row };
}

function loopPartAt(editor: Editor, x: number, reach: number): LoopPart {
  const { loop, window } = editor;
  if (loop === null) return "new";
  const [from, to] = [window.xOf(loop.start), window.xOf(loop.end)];
  const inner = Math.min(reach, (to - from) / 3);
  if (x >= from - reach && x <= from + inner) return "start";
  if (x >= to - inner && x <= to + reach) return "end";
  return x > from && x < to ? "whole" : "new";
}

/** The camera's row shows its shots: what is no key there is one of them. */
function hitShot(editor: Editor, row: Row, x: number): Hit | null {
  if (row.kind !== "group" || row.name !== CAMERA_GROUP) return null;
  const at = editor.window.timeAt(x);
  const index = editor.shots.findIndex(({ start, end }) => at >= start && at < end);
  return index < 0 ? null : { kind: "shot", index };
}

function markerAt(editor: Editor, x: number): number | null {
  const { window } = editor;
  const names = editor.store.document?.markers ?? [];
  const index = editor.markerTimes.findLastIndex((time, place) => {
    const flag = window.xOf(time);
    return x >= flag - 6 && x <= flag + Math.max((names[place]?.name.length ?? 0) * 6 + 10, 14);
  });
  return index < 0 ? null : index;
}

function hitSpan(editor: Editor, x: number, reach: number): Hit | null {
  const { span, window } = editor;
  if (span === null || editor.chosen.length < 2) return null;
  const [from, to] = [window.xOf(span.start), window.xOf(span.end)];
  const grip = Math.max(GRIP, reach);
  if (to > from) {
    if (x >= from - grip && x <= from + Math.min(GRIP, (to - from) / 3)) return { kind: "grip", side: "start" };
    if (x >= to - Math.min(GRIP, (to - from) / 3) && x <= to + grip) return { kind: "grip", side: "end" };
  }
  return x >= from && x <= to ? { kind: "span" } : null;
}

function hitKeys(editor: Editor, row: Row, x: number, reach: number): Hit | null {
  const at = editor.window.timeAt(x);
  const within = reach / editor.window.scale;
  const tracks = (row.kind === "track" ? [row.track] : row.tracks).filter(
    ({ parameter }) => editor.parameter(parameter) !== null,
  );
  let best: number | null = null;
  for (const track of tracks) {
    const times = editor.times.of(track);
    const time = times[nearest(times, at)];
    if (time === undefined || Math.abs(time - at) > within) continue;
    if (best === null || Math.abs(time - at) < Math.abs(best - at)) best = time;
  }
  if (best === null) return null;
  const time = best;
  return { kind: "key", keys: tracks.flatMap((track) => keysAt(editor, track, time)), time, row };
}

function keysAt(editor: Editor, track: ShowTrack, time: number): KeyName[] {
  const times = editor.times.of(track);
  const index = nearest(times, time);
  const found = times[index];
  const key = track.keyframes[index]?.key;
  return found === undefined || key === undefined || Math.abs(found - time) > TOGETHER_S
    ? []
    : [[track.parameter, key]];
}

/** The keys in a box: song times and content rows, in pixels from the first row's upper edge. */
export function keysInBox(
  editor: Editor,
  layout: Layout,
  box: { readonly from: number; readonly to: number; readonly top: number; readonly bottom: number },
): KeyName[] {
  const first = Math.max(Math.floor(box.top / layout.row), 0);
  const last = Math.floor(box.bottom / layout.row);
  const tracks = editor.rows.slice(first, last + 1).flatMap((row) => {
    if (row.kind === "track") return [row.track];
    return row.open ? [] : row.tracks;
  });
  return tracks.flatMap((track) => {
    if (editor.parameter(track.parameter) === null) return [];
    const times = editor.times.of(track);
    return track.keyframes
      .filter((_, index) => (times[index] ?? -1) >= box.from && (times[index] ?? -1) <= box.to)
      .map(({ key }): KeyName => [track.parameter, key]);
  });
}
