import type { Casting, InstrumentSummary } from "../generated/protocol";

/**
 * What somebody who is added plays: the instrument of the last player, passing over those of which there is one on the
 * stage at most.
 *
 * @returns its name; undefined where nothing can be added.
 */
export function anothers(
  there: readonly Pick<InstrumentSummary, "name" | "seat">[],
  castings: readonly Pick<Casting, "instrument">[],
): string | undefined {
  const played = castings.map(({ instrument }) => instrument);
  const possible = there.filter(({ seat }) => seat === null).map(({ name }) => name);
  return played.findLast((name) => possible.includes(name)) ?? possible[0];
}
