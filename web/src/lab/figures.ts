/** How the lab writes numbers. */

const PER_RADIAN = 180 / Math.PI;

export const degrees = (radians: number): number => radians * PER_RADIAN;
export const radians = (angle: number): number => angle / PER_RADIAN;

/** A number with so many decimals, a true minus, and no minus before zero. */
export function decimal(value: number, digits: number): string {
  const text = value.toFixed(digits);
  if (!text.startsWith("-")) return text;
  return Number(text) === 0 ? text.slice(1) : `−${text.slice(1)}`;
}

/** An angle in degrees, of radians. */
export function angle(value: number, digits = 1): string {
  return `${decimal(degrees(value), digits)}°`;
}

/** A length in millimetres, of metres; what is no more than rounding is said so. */
export function millimetres(metres: number): string {
  if (metres < 1e-9) return "0 mm";
  if (metres < 1e-5) return "< 0.01 mm";
  return `${decimal(metres * 1000, metres < 0.01 ? 2 : 1)} mm`;
}

/** A small error: plain where it can be read, else as a power of ten. */
export function small(value: number): string {
  if (value === 0) return "0";
  if (Math.abs(value) >= 0.0005) return decimal(value, 3);
  return value.toExponential(0).replace("-", "−");
}

/** `rightIndexProximal` as a person says it: "right index proximal". */
export function spoken(name: string): string {
  return name
    .replace(/([a-z])([A-Z0-9])/g, "$1 $2")
    .toLowerCase()
    .replace(/_/g, " ");
}

/** Four bytes a number, little-endian, from base64. */
export function floats(base64: string): Float32Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return new Float32Array(bytes.buffer);
}
