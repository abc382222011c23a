/** The rates that a musician practises at, as shares of the written tempo. */
export const RATES: readonly number[] = [0.25, 0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1, 1.1, 1.25, 1.5, 2];

/** The next rate above (1) or below (-1) the one given; at the ends, the last one. */
export function nextRate(rate: number, direction: 1 | -1): number {
  const next =
    direction === 1 ? RATES.find((each) => each > rate + 1e-6) : RATES.findLast((each) => each < rate - 1e-6);
  return next ?? (direction === 1 ? Math.max(rate, 2) : Math.min(rate, 0.25));
}
