import type { Editor } from "../state/editor.svelte";
import type { Row } from "../state/rows";
import type { ShowTrack } from "../state/show-document";
import type { KeyRow } from "./draw-keys";
import { headHeight, type Layout } from "./layout";

/** The rows on screen, each with the y of its upper edge. */
export function rowsOnScreen(editor: Editor, layout: Layout, height: number): { row: Row; y: number }[] {
  const head = headHeight(layout);
  const first = Math.floor(editor.scrollTop / layout.row);
  const count = Math.ceil((height - head) / layout.row) + 1;
  return editor.rows.slice(first, first + count).map((row, place) => ({
    row,
    y: head + (first + place) * layout.row - editor.scrollTop,
  }));
}

/** What of a row's keyframes is to be drawn: a group shows those of all its tracks. */
export function keyRows(editor: Editor, { row, y }: { row: Row; y: number }, layout: Layout, solo: boolean): KeyRow[] {
  const middle = y + layout.row / 2;
  const tracks = row.kind === "track" ? [row.track] : row.tracks;
  return tracks.map((track) => ({
    y: middle,
    track,
    times: editor.times.of(track),
    isColor: editor.parameter(track.parameter)?.type === "color",
    silent: isSilent(track, solo),
    chosen: editor.held.get(track.parameter) ?? null,
    small: row.kind === "group",
  }));
}

/** Whether a track is left out: it is muted, or others play alone. */
export function isSilent(track: ShowTrack, solo: boolean): boolean {
  return track.muted === true || (solo && track.solo !== true);
}
