/** Valves as they stand under notes: `0` for open, `1-2`; `×` for what cannot be played. */
export function fingeringText(valves: readonly number[] | null): string {
  if (valves === null) return "×";
  return valves.length === 0 ? "0" : valves.join("-");
}
