/** What easings, kinds of values and words of paths are called where musicians read them, if not by their own names. */

const EASINGS: Readonly<Record<string, string>> = {
  step: "jump",
  linear: "straight",
  cubic_bezier: "own curve",
  cubic_spline: "own slopes",
  automatic: "smooth",
  clamped: "smooth, never beyond",
};

const TYPES: Readonly<Record<string, string>> = {
  boolean: "on or off",
  color: "colour",
  orientation: "turn",
  transform: "place and turn",
  vector: "three numbers",
};

const WORDS: Readonly<Record<string, string>> = {
  bloom: "glow",
  color: "colour",
  fov: "angle of view",
};

const OPTIONS: Readonly<Record<string, string>> = {
  amplitude: "Swing",
  handles: "Handles",
  overshoot: "Goes beyond by",
  period: "Swing's length",
};

/** An easing's name: `sine_in_out` as `sine in out`. */
export function easingName(name: string): string {
  return EASINGS[name] ?? name.replaceAll("_", " ");
}

/** What kind of value a parameter has. */
export function typeName(type: string): string {
  return TYPES[type] ?? type;
}

/** A word of a parameter's path. */
export function shownWord(word: string): string {
  return WORDS[word] ?? word;
}

/** A setting of an easing. */
export function optionName(name: string): string {
  return OPTIONS[name] ?? name.replaceAll("_", " ");
}
