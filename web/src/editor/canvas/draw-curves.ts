import { shownNumber, shownUnit } from "../state/parameter-value";
import { componentNames, componentsOf } from "../state/component-values";
import type { CurvedTrack } from "../state/curve-view.svelte";
import type { Handle } from "../state/curve-handles";
import { COMPONENT_INK, font, INK } from "./ink";

/** Where curves are drawn, and what is held. */
export interface CurvesPlace {
  readonly from: number;
  readonly scale: number;
  readonly width: number;
  readonly top: number;
  readonly height: number;
}

/** A keyframe's mark, or a handle, where it is drawn: song time and value. */
export interface Placed {
  readonly time: number;
  readonly value: number;
}

const PAD = 14;

export function yOf({ top, height }: CurvesPlace, { low, high }: CurvedTrack, value: number): number {
  return top + PAD + (1 - (value - low) / (high - low)) * (height - 2 * PAD);
}

export function valueAt({ top, height }: CurvesPlace, { low, high }: CurvedTrack, y: number): number {
  return low + (1 - (y - top - PAD) / (height - 2 * PAD)) * (high - low);
}

/** The scale of the track that is looked at. */
export function drawScale(context: CanvasRenderingContext2D, place: CurvesPlace, shown: CurvedTrack): void {
  const { low, high, parameter } = shown;
  const step = niceStep((high - low) / Math.max(place.height / 42, 1), parameter.unit);
  context.font = font(10);
  for (let value = Math.ceil(low / step) * step; value <= high; value += step) {
    const y = Math.round(yOf(place, shown, value));
    context.fillStyle = INK.line;
    context.fillRect(0, y, place.width, 1);
    context.fillStyle = INK.soft;
    const text = `${Number(shownNumber(value, parameter.unit).toPrecision(4))}${parameter.unit === "" ? "" : ` ${shownUnit(parameter.unit)}`}`;
    context.fillText(text, 6, y - 3);
  }
}

/** One track's curves, a line a component, broken where the value jumps. */
export function drawCurve(context: CanvasRenderingContext2D, place: CurvesPlace, shown: CurvedTrack): void {
  const { curve, parameter } = shown;
  if (curve === null) return;
  const names = componentNames(parameter);
  curve.values.forEach((values, component) => {
    if (values.length === 0) return;
    const step = values.length > 1 ? (curve.to - curve.from) / (values.length - 1) : 0;
    const jumps = new Set(curve.jumps);
    context.beginPath();
    values.forEach((value, index) => {
      const x = (curve.from + index * step - place.from) * place.scale;
      const y = yOf(place, shown, value);
      if (index === 0) context.moveTo(x, y);
      else if (jumps.has(index)) {
        // A jump happens at its key's time: the line holds until then.
        context.lineTo(x, yOf(place, shown, values[index - 1] ?? value));
        context.moveTo(x, y);
      } else context.lineTo(x, y);
    });
    context.globalAlpha = shown.active ? 1 : 0.45;
    context.strokeStyle = COMPONENT_INK[component] ?? INK.paper;
    context.lineWidth = shown.active ? 2 : 1.25;
    context.stroke();
    nameLine(context, place, shown, component, names[component] ?? "");
    context.globalAlpha = 1;
  });
}

function nameLine(
  context: CanvasRenderingContext2D,
  place: CurvesPlace,
  shown: CurvedTrack,
  component: number,
  name: string,
): void {
  const { curve } = shown;
  if (name === "" || curve === null) return;
  const values = curve.values[component] ?? [];
  const at = (place.from + (place.width - 16) / place.scale - curve.from) / Math.max(curve.to - curve.from, 1e-9);
  const value = values[Math.min(Math.max(Math.round(at * (values.length - 1)), 0), values.length - 1)];
  if (value === undefined) return;
  context.fillStyle = COMPONENT_INK[component] ?? INK.paper;
  context.font = font(11, 600);
  context.fillText(name, place.width - 14, yOf(place, shown, value) - 5);
}

/** A track's keyframes on its curves. */
export function drawCurveKeys(
  context: CanvasRenderingContext2D,
  place: CurvesPlace,
  shown: CurvedTrack,
  times: Float64Array,
  chosen: ReadonlySet<string> | null,
  held: (key: string, component: number, at: Placed) => Placed,
): void {
  const { track, parameter } = shown;
  const reach = 8 / place.scale;
  track.keyframes.forEach((keyframe, index) => {
    const time = times[index] ?? 0;
    const isChosen = chosen?.has(keyframe.key) === true;
    if (!isChosen && (time < place.from - reach || time > place.from + place.width / place.scale + reach)) return;
    componentsOf(parameter, keyframe.value).forEach((value, component) => {
      const at = isChosen ? held(keyframe.key, component, { time, value }) : { time, value };
      const [x, y] = [(at.time - place.from) * place.scale, yOf(place, shown, at.value)];
      const size = isChosen ? 6 : shown.active ? 5 : 3.5;
      context.beginPath();
      context.moveTo(x, y - size);
      context.lineTo(x + size, y);
      context.lineTo(x, y + size);
      context.lineTo(x - size, y);
      context.closePath();
      context.fillStyle = isChosen ? INK.brass : (COMPONENT_INK[component] ?? INK.paper);
      context.globalAlpha = shown.active || isChosen ? 1 : 0.6;
      context.fill();
      if (isChosen) {
        context.strokeStyle = INK.paper;
        context.lineWidth = 1.5;
        context.stroke();
      }
      context.globalAlpha = 1;
    });
  });
}

/** A handle, on its thread. Song times, seconds. */
export function drawHandle(
  context: CanvasRenderingContext2D,
  place: CurvesPlace,
  shown: CurvedTrack,
  handle: Handle,
  at: Placed,
  hangsOn: Placed,
): void {
  const point = (each: Placed): [number, number] => [
    (each.time - place.from) * place.scale,
    yOf(place, shown, each.value),
  ];
  const [x, y] = point(at);
  context.strokeStyle = INK.soft;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(...point(hangsOn));
  context.lineTo(x, y);
  context.stroke();
  context.beginPath();
  context.arc(x, y, 4.5, 0, 2 * Math.PI);
  context.fillStyle = INK.ink;
  context.fill();
  context.strokeStyle = COMPONENT_INK[handle.component] ?? INK.paper;
  context.lineWidth = 2;
  context.stroke();
}

/** 1, 2 or 5 times a power of ten; angles go by steps of degrees. */
function niceStep(least: number, unit: string): number {
  const shown = unit === "rad" ? (least * 180) / Math.PI : least;
  const power = 10 ** Math.floor(Math.log10(Math.max(shown, 1e-9)));
  const step = ([1, 2, 5].find((each) => each * power >= shown) ?? 10) * power;
  return unit === "rad" ? (step * Math.PI) / 180 : step;
}
