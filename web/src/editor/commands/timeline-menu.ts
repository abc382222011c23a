import { keysMenu, markerMenu, rowMenu, rulerMenu, shotMenu } from "./menus";
import type { Hit, KeyName } from "../gestures/hit";
import type { Editor } from "../state/editor.svelte";
import type { OpenMenu } from "../state/menu";
import { shownPath } from "../state/names";
import { groupName, groupOf, type Row } from "../state/rows";
import type { ShowTrack } from "../state/show-document";
import { does } from "../../words/editor-does/en";

type Menu = Pick<OpenMenu, "label" | "entries">;

/** The menu of what a pointer meets on the rows or above them; keyframes, a marker or a track are chosen first. */
export function menuOfHit(editor: Editor, hit: Hit, at: number): Menu {
  switch (hit.kind) {
    case "key":
      return ofKeys(editor, hit.keys);
    case "grip":
    case "span":
      return { label: does.menuKeys, entries: keysMenu(editor) };
    case "marker":
      editor.marker = hit.index;
      return { label: does.menuMarker, entries: markerMenu(editor, hit.index) };
    case "shot":
      return { label: does.menuShot, entries: shotMenu(editor, hit.index, at) };
    case "row":
      return hit.row === null ? ofRuler(editor, at) : ofRow(editor, hit.row, at);
    default:
      return ofRuler(editor, at);
  }
}

/** The menu of a keyframe on a curve, or else of a place on a track's curve. */
export function menuOfCurves(editor: Editor, key: KeyName | null, track: ShowTrack | null, at: number): Menu {
  if (key !== null) return ofKeys(editor, [key]);
  return track === null ? ofRuler(editor, at) : ofRow(editor, rowOf(track), at);
}

/** The keyboard's menu: of the chosen keyframes or marker, else of the track that is looked at, else of the ruler. */
export function menuOfChoice(editor: Editor): Menu {
  const track = editor.track(editor.active);
  if (editor.chosen.length > 0) return { label: does.menuKeys, entries: keysMenu(editor) };
  if (editor.marker !== null) return { label: does.menuMarker, entries: markerMenu(editor, editor.marker) };
  return track === null ? ofRuler(editor, editor.playhead) : ofRow(editor, rowOf(track), editor.playhead);
}

function ofKeys(editor: Editor, keys: readonly KeyName[]): Menu {
  if (!keys.every(([path, key]) => editor.selection.has(path, key))) editor.selection.set(keys);
  editor.look(keys[0]?.[0] ?? null);
  return { label: does.menuKeys, entries: keysMenu(editor) };
}

function ofRow(editor: Editor, row: Row, at: number): Menu {
  if (row.kind === "track") editor.look(row.track.parameter);
  const label = row.kind === "group" ? groupName(row.name) : shownPath(row.track.parameter);
  return { label, entries: rowMenu(editor, row, at) };
}

function ofRuler(editor: Editor, at: number): Menu {
  return { label: does.menuTimeline, entries: rulerMenu(editor, at) };
}

function rowOf(track: ShowTrack): Row {
  return { kind: "track", group: groupOf(track.parameter), track };
}
