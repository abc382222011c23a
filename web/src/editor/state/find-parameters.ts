import type { ShowParameter } from "../../generated/protocol";
import { shownPath } from "./parameter-value";

/** What people call things, by the words of paths that they mean. */
const SYNONYMS: Readonly<Record<string, readonly string[]>> = {
  aperture: ["blur", "bokeh", "depth of field", "dof", "f-stop", "iris"],
  ambient: ["base light", "general"],
  arrangement: ["layout"],
  background: ["backdrop", "sky"],
  blocks: ["notes"],
  bloom: ["glow", "glare"],
  color: ["colour", "hue", "tint"],
  density: ["mist", "smoke", "thickness"],
  exposure: ["brightness", "gain"],
  face: ["expression", "mimic"],
  fill: ["soft light"],
  finish: ["lacquer", "silver", "gold", "brass"],
  floor: ["ground"],
  focus: ["sharpness"],
  fog: ["mist", "smoke", "haze"],
  fov: ["zoom", "lens", "focal length", "field of view", "angle of view"],
  haze: ["fog", "beam", "smoke", "volumetric"],
  intensity: ["brightness", "level", "dimmer", "power"],
  key: ["main light", "sun"],
  opacity: ["alpha", "transparency", "fade"],
  position: ["move", "place", "location", "dolly", "path"],
  rim: ["back light", "backlight", "edge light"],
  roll: ["tilt", "dutch", "bank"],
  softness: ["penumbra", "shadow"],
  speed: ["scroll", "tempo"],
  spots: ["spotlight", "beam", "followspot"],
  style: ["toon", "cartoon", "cel", "comic", "anime", "drawn", "look"],
  target: ["look at", "aim", "pan"],
  threshold: ["cutoff"],
  visible: ["show", "hide", "on", "off"],
};

/** What of a parameter is searched. */
export type Described = Pick<ShowParameter, "path" | "documentation" | "type">;

/** How well a word that is sought fits, the best first. */
const FITS = ["whole", "start", "synonym", "within", "described"] as const;
type Fit = (typeof FITS)[number];

/**
 * The parameters that are meant by some words, best first; those that fit alike keep their order.
 *
 * A word counts most where the path has it, as a whole or at a word's start, then where people call the thing so, then
 * within the path, and least where only the description has it. All words must fit.
 */
export function findParameters<T extends Described>(parameters: readonly T[], sought: string): T[] {
  const words = sought
    .toLowerCase()
    .split(/[\s/_]+/)
    .filter((word) => word !== "");
  return parameters
    .flatMap((parameter) => {
      const ranks = words.map((word) => rankOf(parameter, word));
      return ranks.includes(-1) ? [] : [{ parameter, rank: ranks.reduce((sum, rank) => sum + rank, 0) }];
    })
    .sort((a, b) => a.rank - b.rank)
    .map(({ parameter }) => parameter);
}

/** Index in FITS of the best fit; -1 for none. */
function rankOf({ path, documentation, type }: Described, word: string): number {
  const words = path.toLowerCase().split(/[_/]/);
  const inPath = [...words, ...shownPath(path).toLowerCase().split(" ")];
  const called = words.flatMap((each) => SYNONYMS[each] ?? []);
  const fits: Record<Fit, boolean> = {
    whole: inPath.includes(word),
    start: inPath.some((each) => each.startsWith(word)),
    synonym: called.some((name) => name.split(/[ -]/).some((each) => each.startsWith(word))),
    within: inPath.some((each) => each.includes(word)),
    described: `${documentation} ${type}`.toLowerCase().includes(word),
  };
  return FITS.findIndex((fit) => fits[fit]);
}
