import { language } from "./language";

/** A number as the language that is shown writes it: `1,024`, `1.024`. */
export function number(value: number, options?: Intl.NumberFormatOptions): string {
  return new Intl.NumberFormat(language(), options).format(value);
}

/** A day as the language that is shown writes it: `3 May 2026`, `3. Mai 2026`, `2026年5月3日`. */
export function day(time: string): string {
  const shown = language() === "en" ? "en-GB" : language();
  return new Intl.DateTimeFormat(shown, { dateStyle: "long" }).format(new Date(time));
}

/** What stands before tenths: a point or a comma. */
export function decimalSign(): string {
  const parts = new Intl.NumberFormat(language()).formatToParts(1.5);
  return parts.find(({ type }) => type === "decimal")?.value ?? ".";
}

/** Things in a row: `1, 2 and 3`, `1, 2 und 3`, `1、2、3`. */
export function list(items: readonly string[]): string {
  // British English has no comma before its last "and".
  return new Intl.ListFormat(language() === "en" ? "en-GB" : language(), { type: "conjunction" }).format(items);
}

/** Names beside each other, without an "and": `A, B`, `A、B`. */
export function row(items: readonly string[]): string {
  return items.join(language() === "ja" ? "、" : ", ");
}

/** Milliseconds with their sign, as +20 ms. */
export function milliseconds(value: number): string {
  return new Intl.NumberFormat(language(), {
    style: "unit",
    unit: "millisecond",
    signDisplay: "exceptZero",
  }).format(value);
}

/** How large something is, as megabytes: `0.4 MB`, `31 MB`. */
export function megabytes(bytes: number): string {
  const megabytes = bytes / 1e6;
  const digits = megabytes < 9.95 ? 1 : 0;
  return number(megabytes, { style: "unit", unit: "megabyte", maximumFractionDigits: digits });
}
