import { HEADER_SIZE, type Manifest, type ShowParameter } from "../../generated/protocol";

/** What a parameter's value is called in a show's JSON, read from the floats of the frame on screen. */
export function valueOnScreen(manifest: Manifest, floats: Float32Array, parameter: ShowParameter): unknown {
  const place = manifest.parameters.find(({ path }) => path === parameter.path);
  if (place === undefined) return parameter.default;
  const from = (place.offset - HEADER_SIZE) / 4;
  const values = [...floats.subarray(from, from + place.length)].map((value) => Number(value.toPrecision(6)));
  return valueOf(parameter, values);
}

/** What a parameter's value is called in a show's JSON. */
export function valueOf(parameter: ShowParameter, values: readonly number[]): unknown {
  const [first = 0] = values;
  switch (parameter.type) {
    case "number":
      return first;
    case "boolean":
      return first > 0.5;
    case "choice":
      return parameter.choices[Math.round(first)] ?? parameter.default;
    case "color":
      return hexOf(values);
    case "transform":
      return { position: values.slice(0, 3), orientation: values.slice(3, 7), scale: values.slice(7, 10) };
    default:
      return [...values];
  }
}

/** `#RRGGBB` of a colour as JSON writes it: that, or three linear components. */
export function hexOf(color: unknown): string {
  if (typeof color === "string") return color.toUpperCase();
  if (!Array.isArray(color)) return "#000000";
  const bytes = color.slice(0, 3).map((linear: unknown) => {
    const share = Math.min(Math.max(Number(linear), 0), 1);
    // The sRGB transfer function, IEC 61966-2-1.
    const encoded = share <= 0.0031308 ? 12.92 * share : 1.055 * share ** (1 / 2.4) - 0.055;
    return Math.round(encoded * 255)
      .toString(16)
      .padStart(2, "0");
  });
  return `#${bytes.join("")}`.toUpperCase();
}

/** What the editor shows for a number: angles in degrees, everything else as it is. */
export function shownNumber(value: number, unit: string): number {
  return Number((unit === "rad" ? (value * 180) / Math.PI : value).toPrecision(5));
}

/** The number that stands for what was typed. */
export function typedNumber(shown: number, unit: string): number {
  return unit === "rad" ? (shown * Math.PI) / 180 : shown;
}

/** A unit as it is written behind a number. */
export function shownUnit(unit: string): string {
  return unit === "rad" ? "°" : unit;
}
