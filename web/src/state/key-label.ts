import { keys } from "../words/keys/en";

/** Keys that other keyboards call otherwise. */
const NAMES = { Ctrl: "ctrl", Shift: "shift", Del: "del", Space: "space", Home: "home", End: "endKey" } as const;

/** What stands on keys where the language is at home: `Ctrl Z` as `Strg Z`. */
export function keyLabel(shown: string): string {
  return shown
    .split(" ")
    .map((key) => (Object.hasOwn(NAMES, key) ? keys[NAMES[key as keyof typeof NAMES]] : key))
    .join(" ");
}
