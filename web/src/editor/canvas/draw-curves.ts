import { shownPath } from "../state/names";
import { shownNumber, shownUnit } from "../state/parameter-value";
import { componentNames, componentsOf } from "../state/component-values";
import type { CurvedTrack } from "../state/curve-view.svelte";
import type { Handle } from "../state/curve-handles";
import { scaleName } from "../state/value-scales";
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

const COLUMN = 46;

/**
 * The scales of what is drawn: lines for the one that is looked at, and beside its numbers those of the other units.
 *
 * @param shown the one that is looked at comes last.
 * @param normalised whether each unit has its own scale; otherwise all share one, of plain numbers.
 */
export function drawScales(
  context: CanvasRenderingContext2D,
  place: CurvesPlace,
  shown: readonly CurvedTrack[],
  normalised: boolean,
): void {
  const scales = new Map<string, CurvedTrack>();
  for (const each of [...shown].reverse()) {
    const name = normalised ? scaleName(each.parameter) : "";
    if (!scales.has(name)) scales.set(name, each);
  }
  const plain = !normalised && new Set(shown.map(({ parameter }) => parameter.unit)).size > 1;
  [...scales].forEach(([name, each], column) => {
    const x = 6 + column * COLUMN;
    if (x + COLUMN > place.width / 2) return;
    drawScale(context, place, each, { x, lines: column === 0, unit: plain ? "" : each.parameter.unit });
    if (scales.size === 1) return;
    context.fillStyle = inkOf(each, 0);
    context.font = font(10, 600);
    context.fillText(name, x, place.top + 11);
  });
}

function drawScale(
  context: CanvasRenderingContext2D,
  place: CurvesPlace,
  shown: CurvedTrack,
  { x, lines, unit }: { x: number; lines: boolean; unit: string },
): void {
  const { low, high, parameter } = shown;
  const step = niceStep((high - low) / Math.max(place.height / 42, 1), parameter.unit);
  context.font = font(10);
  for (let value = Math.ceil(low / step) * step; value <= high; value += step) {
    const y = Math.round(yOf(place, shown, value));
    // The name of the scale stands there.
    if (!lines && y < place.top + 24) continue;
    context.fillStyle = INK.line;
    if (lines) context.fillRect(0, y, place.width, 1);
    context.fillStyle = lines ? INK.soft : INK.faint;
    const number = Number(shownNumber(value, parameter.unit).toPrecision(4));
    context.fillText(unit === "" ? `${number}` : `${number} ${shownUnit(unit)}`, x, y - 3);
  }
}

/** The ink of a curve: a value's components each have one, and so have numbers that are drawn together. */
function inkOf({ parameter, place }: CurvedTrack, component: number): string {
  const first = parameter.type === "number" ? place : 0;
  return COMPONENT_INK[(first + component) % COMPONENT_INK.length] ?? INK.paper;
}

/** One track's curves, a line a component, broken where the value jumps. */
export function drawCurve(context: CanvasRenderingContext2D, place: CurvesPlace, shown: CurvedTrack): void {
  const { curve } = shown;
  if (curve === null) return;
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
    context.strokeStyle = inkOf(shown, component);
    context.lineWidth = shown.active ? 2 : 1.25;
    context.stroke();
    context.globalAlpha = 1;
  });
}

const NAME_HEIGHT = 13;

/** What each line is, where it leaves the screen; names that would lie over one another stand apart. */
export function drawNames(context: CanvasRenderingContext2D, place: CurvesPlace, shown: readonly CurvedTrack[]): void {
  const names = shown.flatMap((each) => {
    const { curve, parameter } = each;
    if (curve === null) return [];
    const components = componentNames(parameter);
    const at = (place.from + (place.width - 16) / place.scale - curve.from) / Math.max(curve.to - curve.from, 1e-9);
    return curve.values.flatMap((values, component) => {
      const value = values[Math.min(Math.max(Math.round(at * (values.length - 1)), 0), values.length - 1)];
      const text = [...(shown.length > 1 ? [shownPath(parameter.path)] : []), components[component] ?? ""]
        .join(" ")
        .trim();
      if (value === undefined || text === "") return [];
      return [{ text, y: yOf(place, each, value) - 5, ink: inkOf(each, component), active: each.active }];
    });
  });
  names.sort((a, b) => a.y - b.y);
  context.font = font(11, 600);
  context.textAlign = "right";
  context.lineJoin = "round";
  let least = place.top + 10;
  names.forEach(({ text, y, ink, active }, index) => {
    const room = place.top + place.height - 4 - (names.length - 1 - index) * NAME_HEIGHT;
    const at = Math.max(Math.min(y, room), least);
    least = at + NAME_HEIGHT;
    context.globalAlpha = active ? 1 : 0.75;
    context.strokeStyle = INK.ink;
    context.lineWidth = 3;
    context.strokeText(text, place.width - 6, at);
    context.fillStyle = ink;
    context.fillText(text, place.width - 6, at);
  });
  context.globalAlpha = 1;
  context.textAlign = "left";
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
      context.fillStyle = isChosen ? INK.brass : inkOf(shown, component);
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
  context.strokeStyle = inkOf(shown, handle.component);
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
