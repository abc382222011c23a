/** What easings, kinds of values and words of paths are called where musicians read them, if not by their own names. */

import { serverMessage } from "../../words";
import { names } from "../../words/editor-names/en";

/** Easings whose English name is not their own. */
const EASINGS = {
  step: "step",
  linear: "straight",
  cubic_bezier: "cubic_bezier",
  cubic_spline: "cubic_spline",
  automatic: "automatic",
  clamped: "clamped",
} as const;
const TYPES = ["boolean", "choice", "color", "number", "orientation", "transform", "vector"] as const;
const OPTIONS = ["amplitude", "handles", "overshoot", "period"] as const;

/** Words of paths whose English name is not their own. */
const WORDS = ["bloom", "color", "fov"] as const;

/** An easing's name: `sine_in_out` as `sine in out`. */
export function easingName(name: string): string {
  return Object.hasOwn(EASINGS, name) ? names[EASINGS[name as keyof typeof EASINGS]] : inWords(name, name);
}

/** What kind of value a parameter has. */
export function typeName(type: string): string {
  return nameOf(TYPES, type) ?? type;
}

/** A parameter's path, or the rest of one, as words. */
export function shownPath(path: string): string {
  return path
    .split("/")
    .map((part) =>
      inWords(
        part,
        part
          .split("_")
          .map((word) => nameOf(WORDS, word) ?? word)
          .join(" "),
      ),
    )
    .join(" ");
}

/** One of the values of a parameter that has names for them. */
export function choiceName(choice: string): string {
  return inWords(choice, choice);
}

/** A setting of an easing. */
export function optionName(name: string): string {
  return nameOf(OPTIONS, name) ?? name.replaceAll("_", " ");
}

function nameOf(known: readonly (keyof typeof names)[], name: string): string | undefined {
  const found = known.find((each) => each === name);
  return found === undefined ? undefined : names[found];
}

/** What the language that is shown calls a name of the server's, as a whole or word by word, else its English. */
function inWords(name: string, english: string): string {
  const of = (word: string): string | null => serverMessage("editor-parameters", word);
  const whole = of(name);
  if (whole !== null) return whole;
  const words = name.split("_").map(of);
  return words.includes(null) ? english.replaceAll("_", " ") : words.join(" ");
}
