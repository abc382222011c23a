import type { ShowParameter } from "../../generated/protocol";
import type { CurveReader } from "./curves.svelte";
import type { ShowTrack } from "./show-document";

/** How an interpolation goes from 0 to 1, evenly sampled. */
export type EasingShape = readonly number[];

/** Points of each shape. */
const POINTS = 57;
/** What the shapes of those that go by their neighbours are drawn with. */
const SLOPES: Readonly<Record<string, object>> = { cubic_spline: { in_tangent: 0 } };

/**
 * The shapes of interpolations, asked of the server in one go: a track that comes from 0 to 1 by each of them, one after
 * another. Nothing of the kind is reckoned in the page, so one that a package has added is drawn like the others.
 */
export async function readEasingShapes(
  reader: CurveReader,
  parameters: readonly ShowParameter[],
): Promise<ReadonlyMap<string, EasingShape>> {
  const parameter = parameters.find(
    ({ type, minimum, maximum }) => type === "number" && (minimum ?? -2) <= -1 && (maximum ?? 2) >= 2,
  );
  if (parameter === undefined) return new Map();
  const names = parameter.interpolations;
  const track: ShowTrack = {
    parameter: parameter.path,
    time: "seconds",
    keyframes: names.flatMap((interpolation, index) => [
      { key: `a${index}`, time: 2 * index, value: 0, interpolation: "step", out_tangent: 0 },
      { key: `b${index}`, time: 2 * index + 1, value: 1, interpolation, ...SLOPES[interpolation] },
    ]),
  };
  // Every shape begins and ends on a sample: two seconds hold twice as many steps as a shape.
  const steps = 2 * (POINTS - 1);
  const shapes = new Map<string, EasingShape>();
  const perCall = 16;
  for (let first = 0; first < names.length; first += perCall) {
    const beyond = Math.min(first + perCall, names.length);
    const curve = await reader.preview(track, 2 * first, 2 * beyond, (beyond - first) * steps + 1);
    const values = curve?.values[0];
    if (values === undefined) continue;
    for (let index = first; index < beyond; index += 1) {
      const name = names[index];
      const begin = (index - first) * steps;
      if (name !== undefined) shapes.set(name, values.slice(begin, begin + POINTS));
    }
  }
  return shapes;
}
