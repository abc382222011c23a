import type { Tier } from "../scene";

const TIERS: readonly Tier[] = ["full", "medium", "low"];

/** How much the stage draws: what the address asks for (`?tier=low`), else what the device looks able to. */
export function askedTier(search = location.search): Tier {
  const asked = new URLSearchParams(search).get("tier");
  return TIERS.find((tier) => tier === asked) ?? likelyTier();
}

function likelyTier(): Tier {
  const cores = navigator.hardwareConcurrency;
  const handheld = matchMedia("(pointer: coarse)").matches;
  if (cores <= 2) return "low";
  return handheld || cores <= 4 ? "medium" : "full";
}
