import {
  addCameraKeys,
  addKeyHere,
  copyKeys,
  cutKeys,
  duplicateKeys,
  nudge,
  pasteKeys,
  removeKeys,
  selectAll,
} from "./commands/keys";
import { addMarker, removeMarker } from "./commands/markers";
import { goToKey, showChosen } from "./commands/places";
import { muteTrack, removeTrack, soloTrack } from "./commands/tracks";
import { EDITOR_SHORTCUTS, type EditorAction } from "./shortcut-table";
import type { Editor } from "./state/editor.svelte";
import { does } from "../words/editor-does/en";

const ZOOM = 1.3;

const ACTIONS: Readonly<Record<EditorAction, (editor: Editor) => void>> = {
  undo: ({ store }) => store.undo(),
  redo: ({ store }) => store.redo(),
  add: (editor) => addKeyHere(editor),
  cameraKey: (editor) => {
    const view = editor.deck.hands.currentView?.();
    if (view === undefined) return;
    addCameraKeys(editor, view);
    editor.deck.hands.giveBackCamera?.();
  },
  marker: (editor) => addMarker(editor),
  all: (editor) => selectAll(editor),
  none: ({ selection }) => selection.clear(),
  copy: (editor) => copyKeys(editor),
  cut: (editor) => cutKeys(editor),
  paste: (editor) => pasteKeys(editor),
  duplicate: (editor) => duplicateKeys(editor),
  remove: (editor) => {
    const { size, marker, track } = editor.selection;
    if (size > 0) removeKeys(editor);
    else if (marker !== null) removeMarker(editor, marker);
    else if (track !== null) removeTrack(editor, track);
  },
  before: (editor) => goToKey(editor, -1),
  after: (editor) => goToKey(editor, 1),
  nudgeBack: (editor) => nudge(editor, "beat", -1),
  nudgeOn: (editor) => nudge(editor, "beat", 1),
  barBack: (editor) => nudge(editor, "bar", -1),
  barOn: (editor) => nudge(editor, "bar", 1),
  frameBack: (editor) => nudge(editor, "frame", -1),
  frameOn: (editor) => nudge(editor, "frame", 1),
  mode: (editor) => (editor.mode = editor.mode === "keys" ? "curves" : "keys"),
  snap: (editor) => editor.setSnapping(!editor.snapping),
  showChosen: (editor) => showChosen(editor),
  showAll: ({ window }) => window.showAll(),
  closer: (editor) => zoomAtPlayhead(editor, ZOOM),
  further: (editor) => zoomAtPlayhead(editor, 1 / ZOOM),
  mute: (editor) => {
    if (editor.active !== null) muteTrack(editor, editor.active);
  },
  solo: (editor) => {
    if (editor.active !== null) soloTrack(editor, editor.active);
  },
  find: (editor) => (editor.searchWanted += 1),
  menu: (editor) => editor.openMenuHere(),
};

function zoomAtPlayhead({ window, view }: Editor, factor: number): void {
  const x = window.xOf(view.songTime);
  window.zoom(factor, x >= 0 && x <= window.width ? x : window.width / 2);
}

export function runEditorAction(editor: Editor, action: EditorAction): void {
  ACTIONS[action](editor);
}

/** Take a key press; returns whether it was the editor's. `within`: the keyboard's focus is in the editor. */
export function pressEditorKey(editor: Editor, event: KeyboardEvent, within: boolean): boolean {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const letter = /^[a-z]$/.test(key) || key.startsWith("Arrow") || key === "Enter" || key === "F10";
  const shortcut = EDITOR_SHORTCUTS.find(
    (each) =>
      each.keys.includes(key) &&
      (each.ctrl ?? false) === (event.ctrlKey || event.metaKey) &&
      (each.alt ?? false) === event.altKey &&
      (!letter || (each.shift ?? false) === event.shiftKey) &&
      (within || each.everywhere === true),
  );
  if (shortcut === undefined) return false;
  if (shortcut.needsKeys === true && editor.selection.size === 0) return false;
  if (shortcut.edits === true && !editor.editable) {
    editor.reina.word(does.youWatch, does.youWatchMeans);
    return true;
  }
  runEditorAction(editor, shortcut.action);
  return true;
}
