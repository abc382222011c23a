import { measureTier, type Tier } from "../scene";

const TIERS: readonly Tier[] = ["full", "medium", "low"];

/** How much the stage draws: what the address asks for (`?tier=low`), else what a short measurement finds. */
export function askedTier(search = location.search): Tier {
  const asked = new URLSearchParams(search).get("tier");
  return TIERS.find((tier) => tier === asked) ?? measureTier(matchMedia("(pointer: coarse)").matches);
}
