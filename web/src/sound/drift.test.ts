import { describe, expect, it } from "vitest";
import { DriftWatch, type Correction } from "./drift";
import { PlaybackPath } from "./playback-path";

function readAll(watch: DriftWatch, errors: readonly number[], rate = 1): Correction[] {
  return errors.map((error) => watch.read(error, rate));
}

describe("DriftWatch", () => {
  it("lets an error pass that nobody hears", () => {
    const corrections = readAll(new DriftWatch(), [0.005, -0.0055, 0.0045, 0.005, 0.004, 0.0055]);
    expect(corrections.every(({ kind }) => kind === "none")).toBe(true);
  });

  it("is not misled by a single wild reading", () => {
    expect(readAll(new DriftWatch(), [0.001, 0, 0.9, 0.002, 0]).at(-1)).toEqual({ kind: "none" });
  });

  it("starts anew when the sound is far off", () => {
    expect(readAll(new DriftWatch(), [0.3, 0.3, 0.31, 0.3, 0.3]).at(-1)).toEqual({ kind: "restart" });
  });

  it.each([0.05, -0.08])("levels an error of %f s with one burst", (error) => {
    const correction = readAll(new DriftWatch(), [error, error, error, error, error], 0.5).at(-1);
    if (correction?.kind !== "burst") throw new Error(`a burst was expected, not ${correction?.kind ?? "nothing"}`);
    const path = new PlaybackPath(0, 10 + error, 0.5, null);
    path.changeRate(1, 0.5 * correction.rate);
    path.changeRate(1 + correction.seconds, 0.5);
    const after = 2 + correction.seconds;
    expect(path.errorAt(after, 10 + after * 0.5)).toBeCloseTo(0, 9);
  });

  it("starts counting afresh after a correction", () => {
    const watch = new DriftWatch();
    readAll(watch, [0.05, 0.05, 0.05, 0.05, 0.05]);
    expect(watch.error).toBeNull();
    expect(watch.read(0.05, 1)).toEqual({ kind: "none" });
  });
});
