import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { FrameReader } from "../generated/frame";
import type { Manifest } from "../generated/protocol";

/** One frame as the golden file tells it beside its bytes. */
interface GoldenFrame {
  readonly epoch: number;
  readonly flags: number;
  readonly index: number;
  readonly song_time_s: number;
  readonly due_time_s: number;
  readonly rotations: Record<string, number[][]>;
  readonly root_positions: Record<string, number[]>;
  readonly parameters: Record<string, number[]>;
}

const golden = new URL("../../../tests/golden/", import.meta.url);
const told = JSON.parse(readFileSync(new URL("frame_v1.json", golden), "utf8")) as {
  manifest: Manifest;
  frames: GoldenFrame[];
};
const file = readFileSync(new URL("frame_v1.bin", golden));
const message = new Uint8Array(file).buffer;
const { manifest, frames } = told;

describe("the golden message", () => {
  it("is read by the generated reader as it was written", () => {
    const reader = new FrameReader(manifest);
    expect(reader.open(message)).toBe(frames.length);
    const frame = reader.createFrame();
    frames.forEach((expected, number) => {
      reader.read(number, frame);
      expect(frame).toMatchObject({ version: 1, epoch: expected.epoch, flags: expected.flags, index: expected.index });
      expect(frame.songTimeS).toBe(expected.song_time_s);
      expect(frame.dueTimeS).toBe(expected.due_time_s);
      manifest.skeletons.forEach(({ name }, place) => {
        expect([...(frame.rotations[place] ?? [])]).toEqual(expected.rotations[name]?.flat());
        expect([...(frame.rootPositions[place] ?? [])]).toEqual(expected.root_positions[name]);
      });
      manifest.parameters.forEach(({ path }, place) => {
        expect([...(frame.parameters[place] ?? [])]).toEqual(expected.parameters[path]);
      });
    });
  });
});
