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

// prettier-ignore
export const SHORTCUTS: readonly Shortcut[] = [
  { action: "toggle", keys: [" ", "k"], shown: "Space", says: "Play or pause", controls: true },
  { action: "back", keys: ["ArrowLeft"], shown: "←", says: "Two seconds back", controls: true, repeats: true },
  { action: "forward", keys: ["ArrowRight"], shown: "→", says: "Two seconds on", controls: true, repeats: true },
  { action: "barBack", keys: ["ArrowLeft"], shift: true, shown: "Shift ←", says: "To the bar before", controls: true, repeats: true },
  { action: "barForward", keys: ["ArrowRight"], shift: true, shown: "Shift →", says: "To the next bar", controls: true, repeats: true },
  { action: "begin", keys: ["Home"], shown: "Home", says: "To the beginning", controls: true },
  { action: "end", keys: ["End"], shown: "End", says: "To the end", controls: true },
  { action: "slower", keys: ["-"], shown: "−", says: "Slower", controls: true },
  { action: "faster", keys: ["+", "="], shown: "+", says: "Faster", controls: true },
  { action: "loopStart", keys: ["["], shown: "[", says: "Loop from here", controls: true },
  { action: "loopEnd", keys: ["]"], shown: "]", says: "Loop to here", controls: true },
  { action: "loopOff", keys: ["l"], shown: "L", says: "Loop this phrase, or end the loop", controls: true },
  { action: "zoom", keys: ["z"], shown: "Z", says: "Zoom the timeline to the loop, or to these bars; again: all of it" },
  { action: "louder", keys: ["ArrowUp"], shown: "↑", says: "Louder", repeats: true },
  { action: "quieter", keys: ["ArrowDown"], shown: "↓", says: "Quieter", repeats: true },
  { action: "mute", keys: ["m"], shown: "M", says: "Sound off or on" },
  { action: "camera", keys: ["c"], shown: "C", says: "Give the camera back to the show" },
  { action: "everybody", keys: ["a"], shown: "A", says: "Look at all players" },
  { action: "onePlayer", keys: ["w"], shown: "W", says: "Look at the chosen player" },
  { action: "nextPlayer", keys: ["j"], shown: "J", says: "Choose the next player" },
  { action: "views", keys: ["v"], shown: "V", says: "Views, light and quality" },
  { action: "view1", keys: ["1"], shown: "1", says: "The whole figure" },
  { action: "view2", keys: ["2"], shown: "2", says: "Three-quarter" },
  { action: "view3", keys: ["3"], shown: "3", says: "The valves" },
  { action: "view4", keys: ["4"], shown: "4", says: "The face" },
  { action: "view5", keys: ["5"], shown: "5", says: "As the player sees it" },
  { action: "view6", keys: ["6"], shown: "6", says: "From the hall" },
  { action: "inset", keys: ["i"], shown: "I", says: "The valves in a small picture" },
  { action: "fullscreen", keys: ["f"], shown: "F", says: "Full screen" },
  { action: "piece", keys: ["p"], shown: "P", says: "The piece" },
  { action: "pieces", keys: ["g"], shown: "G", says: "My pieces, and sharing" },
  { action: "show", keys: ["s"], shown: "S", says: "The show" },
  { action: "film", keys: ["r"], shown: "R", says: "Film: record a video, or a still" },
  { action: "paper", keys: ["t"], shown: "T", says: "The part on paper" },
  { action: "names", keys: ["n"], shown: "N", says: "Name notes as written, or as they sound" },
  { action: "open", keys: ["o"], shown: "O", says: "Open a score, a song or a show" },
  { action: "help", keys: ["?"], shown: "?", says: "This list" },
];

/** What keys do while the stage has the keyboard's focus; its arrows and signs go before the page's. */
export const STAGE_SHORTCUTS: readonly Shortcut[] = [
  { action: "orbitLeft", keys: ["ArrowLeft"], shown: "←", says: "Around the player to the left", repeats: true },
  { action: "orbitRight", keys: ["ArrowRight"], shown: "→", says: "Around the player to the right", repeats: true },
  { action: "orbitUp", keys: ["ArrowUp"], shown: "↑", says: "Look from higher up", repeats: true },
  { action: "orbitDown", keys: ["ArrowDown"], shown: "↓", says: "Look from lower down", repeats: true },
  { action: "closer", keys: ["+", "="], shown: "+", says: "Closer", repeats: true },
  { action: "further", keys: ["-"], shown: "−", says: "Further away", repeats: true },
];

const BY_ACTION = new Map([...SHORTCUTS, ...STAGE_SHORTCUTS].map((shortcut) => [shortcut.action, shortcut]));

/** What `title` says of a control: what it does, and its key. */
export function hint(action: Action, says?: string): string {
  const shortcut = BY_ACTION.get(action);
  return shortcut === undefined ? (says ?? "") : `${says ?? shortcut.says} (${shortcut.shown})`;
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
