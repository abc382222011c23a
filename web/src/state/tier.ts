import { measureTier, type Tier } from "../scene";
import type { Quality } from "./storage";

const TIERS: readonly Tier[] = ["full", "medium", "low"];

/** How much the stage draws: what was chosen by hand, or what the address asks for (`?tier=low`), or what a short measurement finds. */
export function askedTier(quality: Quality = "automatic", search = location.search): Tier {
  if (quality !== "automatic") return quality;
  const asked = new URLSearchParams(search).get("tier");
  return TIERS.find((tier) => tier === asked) ?? measureTier(matchMedia("(pointer: coarse)").matches);
}
