import { keyLabel } from "../state/key-label";
import { showKeys } from "../words/show-keys/en";

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
  /** What stands on the key; in `ROWS` the key that opens menus, which has a name for each language, has none. */
  readonly shown: string;
  readonly says: string;
  /** It works wherever the keyboard's focus is, once the editor is open. */
  readonly everywhere?: boolean;
  /** It changes the show. */
  readonly edits?: boolean;
  /** It is about chosen keyframes: without any, the key is the page's. */
  readonly needsKeys?: boolean;
}

type Row = Omit<EditorShortcut, "says">;

// prettier-ignore
const ROWS: readonly Row[] = [
  { action: "undo", keys: ["z"], ctrl: true, shown: "Ctrl Z", everywhere: true, edits: true },
  { action: "redo", keys: ["z"], ctrl: true, shift: true, shown: "Ctrl Shift Z", everywhere: true, edits: true },
  { action: "redo", keys: ["y"], ctrl: true, shown: "Ctrl Y", everywhere: true, edits: true },
  { action: "add", keys: ["Enter"], shown: "Enter", everywhere: true, edits: true },
  { action: "cameraKey", keys: ["c"], shift: true, shown: "Shift C", everywhere: true, edits: true },
  { action: "marker", keys: ["b"], shown: "B", everywhere: true, edits: true },
  { action: "before", keys: [","], shown: ",", everywhere: true },
  { action: "after", keys: ["."], shown: ".", everywhere: true },
  { action: "all", keys: ["a"], ctrl: true, shown: "Ctrl A" },
  { action: "none", keys: ["Escape"], shown: "Esc", needsKeys: true, everywhere: true },
  { action: "copy", keys: ["c"], ctrl: true, shown: "Ctrl C", needsKeys: true },
  { action: "cut", keys: ["x"], ctrl: true, shown: "Ctrl X", needsKeys: true, edits: true },
  { action: "paste", keys: ["v"], ctrl: true, shown: "Ctrl V", edits: true },
  { action: "duplicate", keys: ["d"], ctrl: true, shown: "Ctrl D", needsKeys: true, edits: true },
  { action: "remove", keys: ["Delete", "Backspace"], shown: "Del", edits: true },
  { action: "nudgeBack", keys: ["ArrowLeft"], shown: "←", needsKeys: true, edits: true },
  { action: "nudgeOn", keys: ["ArrowRight"], shown: "→", needsKeys: true, edits: true },
  { action: "barBack", keys: ["ArrowLeft"], shift: true, shown: "Shift ←", needsKeys: true, edits: true },
  { action: "barOn", keys: ["ArrowRight"], shift: true, shown: "Shift →", needsKeys: true, edits: true },
  { action: "frameBack", keys: ["ArrowLeft"], alt: true, shown: "Alt ←", needsKeys: true, edits: true },
  { action: "frameOn", keys: ["ArrowRight"], alt: true, shown: "Alt →", needsKeys: true, edits: true },
  { action: "mode", keys: ["v"], shown: "V", everywhere: true },
  { action: "snap", keys: ["g"], shown: "G", everywhere: true },
  { action: "showChosen", keys: ["z"], shown: "Z", everywhere: true },
  { action: "showAll", keys: ["0"], shown: "0", everywhere: true },
  { action: "closer", keys: ["+", "="], shown: "+" },
  { action: "further", keys: ["-"], shown: "−" },
  { action: "mute", keys: ["m"], shift: true, shown: "Shift M", everywhere: true, edits: true },
  { action: "solo", keys: ["s"], shift: true, shown: "Shift S", everywhere: true, edits: true },
  { action: "find", keys: ["f"], ctrl: true, shown: "Ctrl F" },
  { action: "menu", keys: ["F10"], shift: true, shown: "Shift F10" },
  { action: "menu", keys: ["ContextMenu"], shown: "" },
];

/** A shortcut with what it does in the language that is shown. */
function said(row: Row): EditorShortcut {
  return {
    ...row,
    get shown() {
      return row.shown === "" ? showKeys.menuKey : row.shown;
    },
    get says() {
      return showKeys[row.action];
    },
  };
}

export const EDITOR_SHORTCUTS: readonly EditorShortcut[] = ROWS.map(said);

/** What `title` says of a control: what it does, and its key. */
export function editorHint(action: EditorAction): string {
  const found = EDITOR_SHORTCUTS.find((each) => each.action === action);
  return found === undefined ? "" : showKeys.withKey({ says: found.says, key: keyLabel(found.shown) });
}
