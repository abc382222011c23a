import { search } from "../../words/editor-search/en";
import type { ShowParameter } from "../../generated/protocol";
import { shownPath } from "./names";

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

/** What people call a thing, by the word of its path. */
function synonymsOf(word: string): string[] {
  if (!Object.hasOwn(search, word)) return [];
  return search[word as keyof typeof search].toLowerCase().split(", ");
}

/** Index in FITS of the best fit; -1 for none. */
function rankOf({ path, documentation, type }: Described, word: string): number {
  const words = path.toLowerCase().split(/[_/]/);
  const inPath = [...words, ...shownPath(path).toLowerCase().split(" ")];
  const called = words.flatMap(synonymsOf);
  const fits: Record<Fit, boolean> = {
    whole: inPath.includes(word),
    start: inPath.some((each) => each.startsWith(word)),
    synonym: called.some((name) => name.split(/[ -]/).some((each) => each.startsWith(word))),
    within: inPath.some((each) => each.includes(word)),
    described: `${documentation} ${type}`.toLowerCase().includes(word),
  };
  return FITS.findIndex((fit) => fits[fit]);
}
