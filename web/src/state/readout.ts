import { decimalSign, list } from "../words";
import { piece } from "../words/piece/en";

/** Minutes and seconds as on a clock: `0:07`, `12:30`; with tenths where asked. */
export function clockTime(seconds: number, tenths = false): string {
  const unit = tenths ? 10 : 1;
  const whole = Math.max(Math.floor(seconds * unit + 1e-6), 0);
  const minutes = Math.floor(whole / (60 * unit));
  const rest = whole - minutes * 60 * unit;
  const shown = tenths
    ? `${Math.floor(rest / 10)}`.padStart(2, "0") + `${decimalSign()}${rest % 10}`
    : `${rest}`.padStart(2, "0");
  return `${minutes}:${shown}`;
}

/** Valves as a player says them: `open`, `1`, `1 and 3`; `not playable` for null. */
export function valveNames(valves: readonly number[] | null): string {
  if (valves === null) return piece.notPlayable;
  if (valves.length === 0) return piece.open;
  return list(valves.map((valve) => `${valve}`));
}

/** A rate as a percentage of the written tempo: `75 %`. */
export function percent(share: number): string {
  return piece.percent({ number: Math.round(share * 100) });
}
