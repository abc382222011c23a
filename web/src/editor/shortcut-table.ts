/** Everything that a key does in the show's editor; `?` lists it. */
// prettier-ignore
export type EditorAction =
  | "undo" | "redo" | "add" | "cameraKey" | "marker" | "all" | "none" | "copy" | "cut" | "paste" | "duplicate" | "remove"
  | "before" | "after" | "nudgeBack" | "nudgeOn" | "frameBack" | "frameOn" | "barBack" | "barOn"
  | "mode" | "snap" | "showChosen" | "showAll" | "closer" | "further" | "mute" | "solo" | "find" | "menu";

export interface EditorShortcut {
  readonly action: EditorAction;
  readonly keys: readonly string[];
  /** Ctrl, or Command on a Mac. */
  readonly ctrl?: boolean;
  readonly shift?: boolean;
  readonly alt?: boolean;
  readonly shown: string;
  readonly says: string;
  /** It works wherever the keyboard's focus is, once the editor is open. */
  readonly everywhere?: boolean;
  /** It changes the show. */
  readonly edits?: boolean;
  /** It is about chosen keyframes: without any, the key is the page's. */
  readonly needsKeys?: boolean;
}

// prettier-ignore
export const EDITOR_SHORTCUTS: readonly EditorShortcut[] = [
  { action: "undo", keys: ["z"], ctrl: true, shown: "Ctrl Z", says: "Undo", everywhere: true, edits: true },
  { action: "redo", keys: ["z"], ctrl: true, shift: true, shown: "Ctrl Shift Z", says: "Redo", everywhere: true, edits: true },
  { action: "redo", keys: ["y"], ctrl: true, shown: "Ctrl Y", says: "Redo", everywhere: true, edits: true },
  { action: "add", keys: ["Enter"], shown: "Enter", says: "Keyframe here, on the chosen track", everywhere: true, edits: true },
  { action: "cameraKey", keys: ["c"], shift: true, shown: "Shift C", says: "Camera keyframe from this view", everywhere: true, edits: true },
  { action: "marker", keys: ["b"], shown: "B", says: "Marker here", everywhere: true, edits: true },
  { action: "before", keys: [","], shown: ",", says: "To the keyframe before", everywhere: true },
  { action: "after", keys: ["."], shown: ".", says: "To the next keyframe", everywhere: true },
  { action: "all", keys: ["a"], ctrl: true, shown: "Ctrl A", says: "Choose all keyframes" },
  { action: "none", keys: ["Escape"], shown: "Esc", says: "Choose none; close", needsKeys: true, everywhere: true },
  { action: "copy", keys: ["c"], ctrl: true, shown: "Ctrl C", says: "Copy", needsKeys: true },
  { action: "cut", keys: ["x"], ctrl: true, shown: "Ctrl X", says: "Cut", needsKeys: true, edits: true },
  { action: "paste", keys: ["v"], ctrl: true, shown: "Ctrl V", says: "Paste at the playhead", edits: true },
  { action: "duplicate", keys: ["d"], ctrl: true, shown: "Ctrl D", says: "Duplicate, bars later", needsKeys: true, edits: true },
  { action: "remove", keys: ["Delete", "Backspace"], shown: "Del", says: "Remove", edits: true },
  { action: "nudgeBack", keys: ["ArrowLeft"], shown: "←", says: "Move a beat back", needsKeys: true, edits: true },
  { action: "nudgeOn", keys: ["ArrowRight"], shown: "→", says: "Move a beat on", needsKeys: true, edits: true },
  { action: "barBack", keys: ["ArrowLeft"], shift: true, shown: "Shift ←", says: "Move a bar back", needsKeys: true, edits: true },
  { action: "barOn", keys: ["ArrowRight"], shift: true, shown: "Shift →", says: "Move a bar on", needsKeys: true, edits: true },
  { action: "frameBack", keys: ["ArrowLeft"], alt: true, shown: "Alt ←", says: "Move a frame back", needsKeys: true, edits: true },
  { action: "frameOn", keys: ["ArrowRight"], alt: true, shown: "Alt →", says: "Move a frame on", needsKeys: true, edits: true },
  { action: "mode", keys: ["v"], shown: "V", says: "Keys or curves", everywhere: true },
  { action: "snap", keys: ["g"], shown: "G", says: "Snap on or off", everywhere: true },
  { action: "showChosen", keys: ["z"], shown: "Z", says: "Show what is chosen, or all", everywhere: true },
  { action: "showAll", keys: ["0"], shown: "0", says: "Show the whole piece", everywhere: true },
  { action: "closer", keys: ["+", "="], shown: "+", says: "Zoom in at the playhead" },
  { action: "further", keys: ["-"], shown: "−", says: "Zoom out" },
  { action: "mute", keys: ["m"], shift: true, shown: "Shift M", says: "Mute the chosen track", everywhere: true, edits: true },
  { action: "solo", keys: ["s"], shift: true, shown: "Shift S", says: "Solo the chosen track", everywhere: true, edits: true },
  { action: "find", keys: ["f"], ctrl: true, shown: "Ctrl F", says: "Find a track" },
  { action: "menu", keys: ["F10"], shift: true, shown: "Shift F10", says: "Menu of what is chosen" },
  { action: "menu", keys: ["ContextMenu"], shown: "Menu key", says: "Menu of what is chosen" },
];

/** What `title` says of a control: what it does, and its key. */
export function editorHint(action: EditorAction): string {
  const found = EDITOR_SHORTCUTS.find((each) => each.action === action);
  return found === undefined ? "" : `${found.says} (${found.shown})`;
}
