/** The page's colours as a canvas takes them; see styles/tokens.css. */
export const INK = {
  paper: "#f4efe6",
  soft: "rgb(244 239 230 / 0.76)",
  faint: "rgb(244 239 230 / 0.58)",
  line: "rgb(244 239 230 / 0.09)",
  bar: "rgb(244 239 230 / 0.17)",
  stripe: "rgb(244 239 230 / 0.045)",
  active: "rgb(217 164 65 / 0.13)",
  brass: "#d9a441",
  light: "#e8bf6e",
  brassWash: "rgb(217 164 65 / 0.16)",
  loop: "rgb(217 164 65 / 0.34)",
  wave: "rgb(118 150 204 / 0.62)",
  ink: "#14171f",
} as const;

/** Lines of a value's components; their letters stand beside them, so colour does not speak alone. */
export const COMPONENT_INK = ["#e8bf6e", "#9db8ea", "#f0a7a0", "#cfd6c2"] as const;

export function font(size: number, weight = 500): string {
  return `${weight} ${size}px "Instrument Sans", system-ui, sans-serif`;
}

/** Make a canvas as large as its place and clear it; returns its context in CSS pixels. */
export function begin(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
  const ratio = window.devicePixelRatio;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const context = canvas.getContext("2d");
  context?.setTransform(ratio, 0, 0, ratio, 0, 0);
  if (context === null) return null;
  context.clearRect(0, 0, width, height);
  // Chromium may go on showing a canvas that was cleared and then drawn nothing: this is too faint to be seen.
  context.fillStyle = "rgb(0 0 0 / 0.004)";
  context.fillRect(0, 0, 1, 1);
  return context;
}
