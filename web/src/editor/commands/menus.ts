import { loopItems } from "./loops";
import {
  addKeyAt,
  addKeyHere,
  changeKeys,
  chooseKeys,
  copiedCount,
  copyKeys,
  cutKeys,
  duplicateKeys,
  pasteKeys,
  removeKeys,
} from "./keys";
import { addMarker, removeMarker } from "./markers";
import { showChosen } from "./places";
import { muteGroup, muteTrack, removeTrack, soloTrack } from "./tracks";
import type { Editor } from "../state/editor.svelte";
import type { MenuEntry, MenuItem } from "../state/menu";
import { shownPath } from "../state/parameter-value";
import type { Row } from "../state/rows";
import { keysInShot } from "../state/shots";

/** What can be done with the chosen keyframes. */
export function keysMenu(editor: Editor): MenuEntry[] {
  const { chosen, span } = editor;
  const locked = !editor.editable;
  if (span === null) return [];
  const tracks = [...new Set(chosen.map(({ track }) => track))];
  return [
    { says: "Type its value", disabled: locked, run: () => (editor.valueWanted += 1) },
    { says: "How it comes here", disabled: locked, items: wayItems(editor) },
    "line",
    { says: "Copy", key: "Ctrl C", run: () => copyKeys(editor) },
    { says: "Cut", key: "Ctrl X", disabled: locked, run: () => cutKeys(editor) },
    { says: "Paste at the playhead", key: "Ctrl V", disabled: cannotPaste(editor), run: () => pasteKeys(editor) },
    { says: "Duplicate, bars later", key: "Ctrl D", disabled: locked, run: () => duplicateKeys(editor) },
    { says: "Remove", key: "Del", disabled: locked, run: () => removeKeys(editor) },
    "line",
    {
      says: tracks.length === 1 ? "Choose all of this track" : "Choose all of these tracks",
      run: () => chooseKeys(editor, tracks),
    },
    {
      says: tracks.length === 1 ? "Choose this track from here on" : "Choose these tracks from here on",
      run: () => chooseKeys(editor, tracks, span.start - 1e-6),
    },
    "line",
    ...loopItems(editor, span.start, chosen.length > 1 ? span : null),
    goItem(editor, span.start),
    { says: "Show what is chosen", key: "Z", run: () => showChosen(editor) },
  ];
}

/**
 * What can be done with a row.
 *
 * @param at song time of the place in it, seconds; null for the row as a whole, whose keyframes go to the playhead.
 */
export function rowMenu(editor: Editor, row: Row, at: number | null): MenuEntry[] {
  const locked = !editor.editable;
  if (row.kind === "group") {
    const { tracks, name } = row;
    const muted = tracks.every((track) => track.muted === true);
    return [
      { says: row.open ? "Fold up" : "Unfold", run: () => editor.toggleGroup(name) },
      { says: "Choose all of this group", run: () => chooseKeys(editor, known(editor, row)) },
      {
        says: "Mute the group",
        checked: muted,
        disabled: locked,
        run: () =>
          muteGroup(
            editor,
            tracks.map(({ parameter }) => parameter),
          ),
      },
      ...placeItems(editor, at),
    ];
  }
  const { track } = row;
  const path = track.parameter;
  const unknown = editor.parameter(path) === null;
  return [
    {
      says: at === null ? "Keyframe at the playhead" : "Keyframe here",
      ...(at === null ? { key: "Enter" } : {}),
      disabled: locked || unknown,
      run: () => (at === null ? addKeyHere(editor, path) : void addKeyAt(editor, path, at)),
    },
    {
      says: at === null ? "Paste at the playhead" : "Paste here",
      disabled: cannotPaste(editor) || unknown,
      run: () => {
        editor.look(path);
        pasteKeys(editor, at ?? editor.playhead);
      },
    },
    "line",
    { says: "Choose all of this track", disabled: unknown, run: () => chooseKeys(editor, [track]) },
    ...(at === null
      ? []
      : [{ says: "Choose this track from here on", disabled: unknown, run: () => chooseKeys(editor, [track], at) }]),
    {
      says: "Show its curve",
      disabled: unknown,
      run: () => {
        editor.chooseTrack(path);
        editor.mode = "curves";
      },
    },
    "line",
    {
      says: "Mute",
      key: "Shift M",
      checked: track.muted === true,
      disabled: locked || unknown,
      run: () => muteTrack(editor, path),
    },
    {
      says: "Solo",
      key: "Shift S",
      checked: track.solo === true,
      disabled: locked || unknown,
      run: () => soloTrack(editor, path),
    },
    { says: "Remove the track", disabled: locked, run: () => removeTrack(editor, path) },
    ...placeItems(editor, at),
  ];
}

/** What can be done at a place on the ruler, song time, seconds. */
export function rulerMenu(editor: Editor, at: number): MenuEntry[] {
  return [
    goItem(editor, at),
    ...loopItems(editor, at, null),
    "line",
    { says: "Marker here", disabled: !editor.editable, run: () => addMarker(editor, at) },
    { says: "Paste here", disabled: cannotPaste(editor), run: () => pasteKeys(editor, at, undefined, false) },
    { says: "Choose all from here on", run: () => chooseKeys(editor, editor.known, at) },
    "line",
    { says: "Show the whole piece", key: "0", run: () => editor.window.showAll() },
  ];
}

/** What can be done with a marker. */
export function markerMenu(editor: Editor, index: number): MenuEntry[] {
  const at = editor.markerTimes[index] ?? 0;
  const next = editor.markerTimes.find((time) => time > at + 1e-3) ?? editor.view.duration;
  return [
    goItem(editor, at),
    { says: "Rename", disabled: !editor.editable, run: () => (editor.valueWanted += 1) },
    {
      says: "Loop to the next marker",
      disabled: !editor.view.canControl || next - at < 1,
      run: () => void editor.view.setLoop({ start: at, end: next }),
    },
    "line",
    { says: "Remove", key: "Del", disabled: !editor.editable, run: () => removeMarker(editor, index) },
  ];
}

/** What can be done with one of the camera's shots. */
export function shotMenu(editor: Editor, index: number, at: number): MenuEntry[] {
  const shot = editor.shots[index];
  if (shot === undefined) return [];
  const { store, times } = editor;
  return [
    {
      says: "Choose this shot",
      run: () => editor.selection.set(keysInShot(store.document?.tracks ?? [], (track) => times.of(track), shot)),
    },
    { says: "Loop this shot", disabled: !editor.view.canControl, run: () => void editor.view.setLoop(shot) },
    { says: "Show this shot", run: () => editor.window.show(shot.start, shot.end) },
    ...placeItems(editor, at),
  ];
}

function placeItems(editor: Editor, at: number | null): MenuEntry[] {
  return at === null ? [] : ["line", goItem(editor, at), ...loopItems(editor, at, null)];
}

function goItem(editor: Editor, at: number): MenuItem {
  return { says: "Go here", disabled: !editor.view.canControl, run: () => void editor.view.seek(Math.max(at, 0)) };
}

function cannotPaste(editor: Editor): boolean {
  return !editor.editable || copiedCount() === 0;
}

function known(editor: Editor, row: Row & { kind: "group" }) {
  return row.tracks.filter(({ parameter }) => editor.parameter(parameter) !== null);
}

/** Every way that one of the chosen keyframes can come by. */
function wayItems(editor: Editor): MenuItem[] {
  const { chosen } = editor;
  const ways = new Set(chosen.flatMap(({ track }) => editor.parameter(track.parameter)?.interpolations ?? []));
  return [...ways].map((way) => ({
    says: shownPath(way),
    checked: chosen.every(({ keyframe }) => (keyframe.interpolation ?? "linear") === way),
    run: () => changeKeys(editor, `Come by ${shownPath(way)}`, { interpolation: way }),
  }));
}
