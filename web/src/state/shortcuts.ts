import { keyLabel } from "./key-label";
import { keys as words } from "../words/keys/en";

/** Everything that a key does; `?` lists it. */
export type Action =
  | "toggle"
  | "back"
  | "forward"
  | "barBack"
  | "barForward"
  | "begin"
  | "end"
  | "slower"
  | "faster"
  | "loopStart"
  | "loopEnd"
  | "loopOff"
  | "zoom"
  | "louder"
  | "quieter"
  | "mute"
  | "camera"
  | "orbitLeft"
  | "orbitRight"
  | "orbitUp"
  | "orbitDown"
  | "closer"
  | "further"
  | "everybody"
  | "onePlayer"
  | "nextPlayer"
  | "views"
  | "view1"
  | "view2"
  | "view3"
  | "view4"
  | "view5"
  | "view6"
  | "inset"
  | "fullscreen"
  | "piece"
  | "pieces"
  | "show"
  | "film"
  | "paper"
  | "inTime"
  | "practice"
  | "metronome"
  | "noteBack"
  | "noteForward"
  | "names"
  | "open"
  | "help";

export interface Shortcut {
  readonly action: Action;
  /** As KeyboardEvent.key says it, Shift included in what it makes. */
  readonly keys: readonly string[];
  readonly shift?: boolean;
  /** What stands on the key, as the list and the hints show it. */
  readonly shown: string;
  readonly says: string;
  /** It changes the session, which takes its token. */
  readonly controls?: boolean;
  /** Holding the key repeats it. */
  readonly repeats?: boolean;
}

type Row = Omit<Shortcut, "says">;

/** A shortcut with what it does in the language that is shown. */
function said(row: Row): Shortcut {
  return {
    ...row,
    get says() {
      return words[row.action];
    },
  };
}

// prettier-ignore
const ROWS: readonly Row[] = [
  { action: "toggle", keys: [" ", "k"], shown: "Space", controls: true },
  { action: "back", keys: ["ArrowLeft"], shown: "←", controls: true, repeats: true },
  { action: "forward", keys: ["ArrowRight"], shown: "→", controls: true, repeats: true },
  { action: "barBack", keys: ["ArrowLeft"], shift: true, shown: "Shift ←", controls: true, repeats: true },
  { action: "barForward", keys: ["ArrowRight"], shift: true, shown: "Shift →", controls: true, repeats: true },
  { action: "begin", keys: ["Home"], shown: "Home", controls: true },
  { action: "end", keys: ["End"], shown: "End", controls: true },
  { action: "slower", keys: ["-"], shown: "−", controls: true },
  { action: "faster", keys: ["+", "="], shown: "+", controls: true },
  { action: "loopStart", keys: ["["], shown: "[", controls: true },
  { action: "loopEnd", keys: ["]"], shown: "]", controls: true },
  { action: "loopOff", keys: ["l"], shown: "L", controls: true },
  { action: "zoom", keys: ["z"], shown: "Z" },
  { action: "louder", keys: ["ArrowUp"], shown: "↑", repeats: true },
  { action: "quieter", keys: ["ArrowDown"], shown: "↓", repeats: true },
  { action: "mute", keys: ["m"], shown: "M" },
  { action: "camera", keys: ["c"], shown: "C" },
  { action: "everybody", keys: ["a"], shown: "A" },
  { action: "onePlayer", keys: ["w"], shown: "W" },
  { action: "nextPlayer", keys: ["j"], shown: "J" },
  { action: "views", keys: ["v"], shown: "V" },
  { action: "view1", keys: ["1"], shown: "1" },
  { action: "view2", keys: ["2"], shown: "2" },
  { action: "view3", keys: ["3"], shown: "3" },
  { action: "view4", keys: ["4"], shown: "4" },
  { action: "view5", keys: ["5"], shown: "5" },
  { action: "view6", keys: ["6"], shown: "6" },
  { action: "inset", keys: ["i"], shown: "I" },
  { action: "fullscreen", keys: ["f"], shown: "F" },
  { action: "piece", keys: ["p"], shown: "P" },
  { action: "pieces", keys: ["g"], shown: "G" },
  { action: "show", keys: ["s"], shown: "S" },
  { action: "film", keys: ["r"], shown: "R" },
  { action: "paper", keys: ["t"], shown: "T" },
  { action: "inTime", keys: ["h"], shown: "H" },
  { action: "practice", keys: ["x"], shown: "X" },
  { action: "metronome", keys: ["b"], shown: "B" },
  { action: "noteBack", keys: [","], shown: ",", controls: true, repeats: true },
  { action: "noteForward", keys: ["."], shown: ".", controls: true, repeats: true },
  { action: "names", keys: ["n"], shown: "N" },
  { action: "open", keys: ["o"], shown: "O" },
  { action: "help", keys: ["?"], shown: "?" },
];

export const SHORTCUTS: readonly Shortcut[] = ROWS.map(said);

/** What keys do while the stage has the keyboard's focus; its arrows and signs go before the page's. */
const STAGE_ROWS: readonly Row[] = [
  { action: "orbitLeft", keys: ["ArrowLeft"], shown: "←", repeats: true },
  { action: "orbitRight", keys: ["ArrowRight"], shown: "→", repeats: true },
  { action: "orbitUp", keys: ["ArrowUp"], shown: "↑", repeats: true },
  { action: "orbitDown", keys: ["ArrowDown"], shown: "↓", repeats: true },
  { action: "closer", keys: ["+", "="], shown: "+", repeats: true },
  { action: "further", keys: ["-"], shown: "−", repeats: true },
];

export const STAGE_SHORTCUTS: readonly Shortcut[] = STAGE_ROWS.map(said);

const BY_ACTION = new Map([...SHORTCUTS, ...STAGE_SHORTCUTS].map((shortcut) => [shortcut.action, shortcut]));

/** What `title` says of a control: what it does, and its key. */
export function hint(action: Action, says?: string): string {
  const shortcut = BY_ACTION.get(action);
  return shortcut === undefined
    ? (says ?? "")
    : words.withKey({ says: says ?? shortcut.says, key: keyLabel(shortcut.shown) });
}

/** The value of `aria-keyshortcuts` for a control. */
export function ariaKeys(action: Action): string {
  const shortcut = BY_ACTION.get(action);
  const key = shortcut?.keys[0] ?? "";
  const name = key === " " ? "Space" : key === "+" ? "Plus" : key;
  return shortcut?.shift === true ? `Shift+${name}` : name;
}

/** A key press as far as it matters here. */
export type KeyPress = Pick<KeyboardEvent, "key" | "shiftKey" | "ctrlKey" | "metaKey" | "altKey" | "repeat">;

/**
 * What a key press asks for; null for what is no shortcut, or a shortcut of the browser's own.
 *
 * @param onStage whether the stage has the keyboard's focus.
 */
export function shortcutOf(press: KeyPress, onStage = false): Shortcut | null {
  if (press.ctrlKey || press.metaKey || press.altKey) return null;
  const key = press.key.length === 1 ? press.key.toLowerCase() : press.key;
  // Shift only tells arrows apart; what it makes of a letter key is a key of its own already.
  const fits = ({ keys, shift }: Shortcut) =>
    keys.includes(key) && (press.key.length === 1 || (shift ?? false) === press.shiftKey);
  const found = (onStage ? STAGE_SHORTCUTS.find(fits) : undefined) ?? SHORTCUTS.find(fits);
  return found === undefined || (press.repeat && found.repeats !== true) ? null : found;
}
