import { number } from "../words";

/** Minutes, seconds and hundredths, as the language writes them: `0:03.91`, `1:02,50`. */
export function exactTime(seconds: number): string {
  const hundredths = Math.max(Math.round(seconds * 100), 0);
  const minutes = Math.floor(hundredths / 6000);
  const rest = (hundredths - minutes * 6000) / 100;
  return `${minutes}:${number(rest, { minimumIntegerDigits: 2, minimumFractionDigits: 2, maximumFractionDigits: 2 })}`;
}
