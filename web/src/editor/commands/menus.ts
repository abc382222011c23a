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
import { easingName } from "../state/names";
import type { Row } from "../state/rows";
import { keysInShot } from "../state/shots";
import { does } from "../../words/editor-does/en";

/** What can be done with the chosen keyframes. */
export function keysMenu(editor: Editor): MenuEntry[] {
  const { chosen, span } = editor;
  const locked = !editor.editable;
  if (span === null) return [];
  const tracks = [...new Set(chosen.map(({ track }) => track))];
  return [
    { says: does.typeValue, disabled: locked, run: () => (editor.valueWanted += 1) },
    { says: does.howHere, disabled: locked, items: wayItems(editor) },
    "line",
    { says: does.copy, key: "Ctrl C", run: () => copyKeys(editor) },
    { says: does.cut, key: "Ctrl X", disabled: locked, run: () => cutKeys(editor) },
    { says: does.pastePlayhead, key: "Ctrl V", disabled: cannotPaste(editor), run: () => pasteKeys(editor) },
    { says: does.duplicate, key: "Ctrl D", disabled: locked, run: () => duplicateKeys(editor) },
    { says: does.remove, key: "Del", disabled: locked, run: () => removeKeys(editor) },
    "line",
    {
      says: does.allOfTrack({ count: tracks.length }),
      run: () => chooseKeys(editor, tracks),
    },
    {
      says: does.trackFromHere({ count: tracks.length }),
      run: () => chooseKeys(editor, tracks, span.start - 1e-6),
    },
    "line",
    ...loopItems(editor, span.start, chosen.length > 1 ? span : null),
    goItem(editor, span.start),
    { says: does.showChosen, key: "Z", run: () => showChosen(editor) },
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
      { says: row.open ? does.foldUp : does.unfold, run: () => editor.toggleGroup(name) },
      { says: does.allOfGroup, run: () => chooseKeys(editor, known(editor, row)) },
      {
        says: does.muteGroup,
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
      says: at === null ? does.keyPlayhead : does.keyHere,
      ...(at === null ? { key: "Enter" } : {}),
      disabled: locked || unknown,
      run: () => (at === null ? addKeyHere(editor, path) : void addKeyAt(editor, path, at)),
    },
    {
      says: at === null ? does.pastePlayhead : does.pasteHere,
      disabled: cannotPaste(editor) || unknown,
      run: () => {
        editor.look(path);
        pasteKeys(editor, at ?? editor.playhead);
      },
    },
    "line",
    { says: does.allOfTrack({ count: 1 }), disabled: unknown, run: () => chooseKeys(editor, [track]) },
    ...(at === null
      ? []
      : [{ says: does.trackFromHere({ count: 1 }), disabled: unknown, run: () => chooseKeys(editor, [track], at) }]),
    {
      says: does.showCurve,
      disabled: unknown,
      run: () => {
        editor.chooseTrack(path);
        editor.mode = "curves";
      },
    },
    "line",
    {
      says: does.mute,
      key: "Shift M",
      checked: track.muted === true,
      disabled: locked || unknown,
      run: () => muteTrack(editor, path),
    },
    {
      says: does.solo,
      key: "Shift S",
      checked: track.solo === true,
      disabled: locked || unknown,
      run: () => soloTrack(editor, path),
    },
    { says: does.removeTrack, disabled: locked, run: () => removeTrack(editor, path) },
    ...placeItems(editor, at),
  ];
}

/** What can be done at a place on the ruler, song time, seconds. */
export function rulerMenu(editor: Editor, at: number): MenuEntry[] {
  return [
    goItem(editor, at),
    ...loopItems(editor, at, null),
    "line",
    { says: does.markerHere, disabled: !editor.editable, run: () => addMarker(editor, at) },
    { says: does.pasteHere, disabled: cannotPaste(editor), run: () => pasteKeys(editor, at, undefined, false) },
    { says: does.allFromHere, run: () => chooseKeys(editor, editor.known, at) },
    "line",
    { says: does.showAll, key: "0", run: () => editor.window.showAll() },
  ];
}

/** What can be done with a marker. */
export function markerMenu(editor: Editor, index: number): MenuEntry[] {
  const at = editor.markerTimes[index] ?? 0;
  const next = editor.markerTimes.find((time) => time > at + 1e-3) ?? editor.view.duration;
  return [
    goItem(editor, at),
    { says: does.rename, disabled: !editor.editable, run: () => (editor.valueWanted += 1) },
    {
      says: does.loopToMarker,
      disabled: !editor.view.canControl || next - at < 1,
      run: () => void editor.view.setLoop({ start: at, end: next }),
    },
    "line",
    { says: does.remove, key: "Del", disabled: !editor.editable, run: () => removeMarker(editor, index) },
  ];
}

/** What can be done with one of the camera's shots. */
export function shotMenu(editor: Editor, index: number, at: number): MenuEntry[] {
  const shot = editor.shots[index];
  if (shot === undefined) return [];
  const { store, times } = editor;
  return [
    {
      says: does.chooseShot,
      run: () => editor.selection.set(keysInShot(store.document?.tracks ?? [], (track) => times.of(track), shot)),
    },
    { says: does.loopShot, disabled: !editor.view.canControl, run: () => void editor.view.setLoop(shot) },
    { says: does.showShot, run: () => editor.window.show(shot.start, shot.end) },
    ...placeItems(editor, at),
  ];
}

function placeItems(editor: Editor, at: number | null): MenuEntry[] {
  return at === null ? [] : ["line", goItem(editor, at), ...loopItems(editor, at, null)];
}

function goItem(editor: Editor, at: number): MenuItem {
  return { says: does.goHere, disabled: !editor.view.canControl, run: () => void editor.view.seek(Math.max(at, 0)) };
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
    says: easingName(way),
    checked: chosen.every(({ keyframe }) => (keyframe.interpolation ?? "linear") === way),
    run: () => changeKeys(editor, does.comeBy({ easing: easingName(way) }), { interpolation: way }),
  }));
}
