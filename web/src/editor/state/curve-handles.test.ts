import { describe, expect, it } from "vitest";
import type { ShowParameter } from "../../generated/protocol";
import { handleEdit, handlesOf } from "./curve-handles";
import type { ShowTrack } from "./show-document";

const number = { path: "a", type: "number" } as ShowParameter;
const color = { path: "a", type: "color" } as ShowParameter;
const vector = { path: "a", type: "vector" } as ShowParameter;
const track = (interpolation: string, from: unknown, to: unknown, more: object = {}): ShowTrack => ({
  parameter: "a",
  keyframes: [
    { key: "k1", time: 2, value: from, interpolation: "linear" },
    { key: "k2", time: 6, value: to, interpolation, ...more },
  ],
});
const chosen = new Set(["k1"]);

describe("a curve's handles", () => {
  it("of a Bézier stand where its four numbers say, and give those numbers back", () => {
    const bent = track("cubic_bezier", 10, 20, { handles: [0.25, 0, 0.5, 1.2] });
    const [start, end] = handlesOf(bent, number, chosen);
    expect(start).toMatchObject({ kind: "start", key: "k2", time: 3, value: 10, at: { time: 2, value: 10 } });
    expect(end).toMatchObject({ kind: "end", key: "k2", time: 4, value: 22, at: { time: 6, value: 20 } });
    if (start === undefined) throw new Error("there is no handle");
    expect(handleEdit(bent, number, start, 4, 15)).toMatchObject({
      key: "k2",
      changes: { handles: [0.5, 0.5, 0.5, 1.2] },
    });
    expect(handleEdit(bent, number, start, 99, 15)).toMatchObject({ changes: { handles: [1, 0.5, 0.5, 1.2] } });
  });

  it("of a Bézier hang on the component that goes furthest", () => {
    expect(
      handlesOf(track("cubic_bezier", [0, 0, 0], [1, -5, 2]), vector, chosen).map(({ component }) => component),
    ).toEqual([1, 1]);
  });

  it("of a spline are its slopes, and are set by them", () => {
    const curved = track("cubic_spline", 0, 8, { in_tangent: -1 });
    const [out, into] = handlesOf(curved, number, chosen);
    expect(into).toMatchObject({ kind: "in", key: "k2", value: 8 + 4 / 3 });
    if (out === undefined) throw new Error("there is no handle");
    expect(handleEdit(curved, number, out, 4, 3)).toMatchObject({ key: "k1", changes: { out_tangent: 1.5 } });
    // A slope has no handle on the other side of its key.
    expect(handleEdit(curved, number, out, 1, 3)).toBeNull();
  });

  it("of a colour's spline stand on each component, and are set where its colours are mixed", () => {
    const curved = track("cubic_spline", [0.2, 0.5, 0.05], [1, 0, 0], { in_tangent: [0.1, 0, 0] });
    const handles = handlesOf(curved, color, chosen);
    expect(handles.map(({ kind, component }) => `${kind}${component}`)).toEqual([
      "out0",
      "in0",
      "out1",
      "in1",
      "out2",
      "in2",
    ]);
    const red = handles[0];
    if (red === undefined) throw new Error("there is no handle");
    expect(red.value).toBeCloseTo(0.2, 9);
    // Of the three components the others stay: the slope leads to the colour whose red is so much higher.
    const edit = handleEdit(curved, color, red, red.time, 0.3);
    if (edit?.edit !== "change_keyframe") throw new Error("there is no edit");
    const bent: ShowTrack = {
      ...curved,
      keyframes: curved.keyframes.map((each) => (each.key === "k1" ? { ...each, ...edit.changes } : each)),
    };
    const values = handlesOf(bent, color, chosen).filter(({ kind }) => kind === "out");
    [0.3, 0.5, 0.05].forEach((value, component) => expect(values[component]?.value).toBeCloseTo(value, 3));

    const plain = { ...curved, color_space: "linear" } as const;
    expect(handleEdit(plain, color, red, red.time, 0.3)).toMatchObject({
      changes: { out_tangent: [0.075, 0, 0] },
    });
  });

  it("are there for the segments around what is chosen, where they can be bent", () => {
    expect(handlesOf(track("quad_in", 0, 1), number, chosen)).toEqual([]);
    expect(handlesOf(track("cubic_bezier", 0, 1), number, new Set(["other"]))).toEqual([]);
  });
});
