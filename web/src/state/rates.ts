/** The rates that a musician practises at, as shares of the written tempo: from a quarter to twice, by 5 %. */
export const RATES: readonly number[] = Array.from({ length: 36 }, (_, step) => (25 + 5 * step) / 100);

/** The next rate above (1) or below (-1) the one given; at the ends, the last one. */
export function nextRate(rate: number, direction: 1 | -1): number {
  const next =
    direction === 1 ? RATES.find((each) => each > rate + 1e-6) : RATES.findLast((each) => each < rate - 1e-6);
  return next ?? (direction === 1 ? Math.max(rate, 2) : Math.min(rate, 0.25));
}
