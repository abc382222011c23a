import type { SampledCurve } from "../state/curves.svelte";
import { hexOf } from "../state/parameter-value";
import type { KeysView } from "./draw-keys";

const THICK = 8;

/** Draw what a colour's track gives over time, as the server has sampled it, along its row. */
export function drawStrip(
  context: CanvasRenderingContext2D,
  view: KeysView,
  curve: SampledCurve,
  y: number,
  silent: boolean,
): void {
  const [red = [], green = [], blue = []] = curve.values;
  const step = red.length > 1 ? (curve.to - curve.from) / (red.length - 1) : 0;
  if (step <= 0) return;
  context.globalAlpha = silent ? 0.25 : 0.72;
  const pixels = step * view.scale;
  let [begun, color] = [0, ""];
  // Stretches of one colour are one rectangle: most of a show rests.
  for (let index = 0; index <= red.length; index += 1) {
    const next = index < red.length ? hexOf([red[index], green[index], blue[index]]) : "";
    if (next === color) continue;
    // Whole pixels: stretches that share one would show as stripes.
    const left = (curve.from + begun * step - view.from) * view.scale;
    const [x, right] = [Math.round(left), Math.round(left + (index - begun) * pixels)];
    if (color !== "" && right > 0 && x < view.width) {
      context.fillStyle = color;
      context.fillRect(x, y - THICK / 2, right - x, THICK);
    }
    [begun, color] = [index, next];
  }
  context.globalAlpha = 1;
}
