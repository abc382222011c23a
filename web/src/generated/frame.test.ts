import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { FrameReader } from "./frame";
import type { Manifest } from "./protocol";

interface GoldenFrame {
  epoch: number;
  flags: number;
  index: number;
  song_time_s: number;
  due_time_s: number;
  rotations: Record<string, number[][]>;
  root_positions: Record<string, number[]>;
  parameters: Record<string, number[]>;
}

const golden = new URL("../../../tests/golden/", import.meta.url);
const { manifest, frames } = JSON.parse(readFileSync(new URL("frame_v1.json", golden), "utf8")) as {
  manifest: Manifest;
  frames: GoldenFrame[];
};
const bytes = new Uint8Array(readFileSync(new URL("frame_v1.bin", golden)));

describe("FrameReader", () => {
  it("reads the golden message as the server wrote it", () => {
    const reader = new FrameReader(manifest);
    const frame = reader.createFrame();
    expect(reader.open(bytes.slice().buffer)).toBe(frames.length);
    for (const [number, expected] of frames.entries()) {
      reader.read(number, frame);
      expect(frame.version).toBe(1);
      expect(frame.epoch).toBe(expected.epoch);
      expect(frame.flags).toBe(expected.flags);
      expect(frame.index).toBe(expected.index);
      expect(frame.songTimeS).toBe(expected.song_time_s);
      expect(frame.dueTimeS).toBe(expected.due_time_s);
      expect([frame.playing, frame.first, frame.cut]).toEqual([1, 2, 4].map((bit) => (expected.flags & bit) !== 0));
      expect(frame.rotations.map((rotations) => [...rotations])).toEqual(
        Object.values(expected.rotations).map((joints) => joints.flat()),
      );
      expect(frame.rootPositions.map((position) => [...position])).toEqual(Object.values(expected.root_positions));
      for (const [path, value] of Object.entries(expected.parameters)) {
        expect([...(frame.parameters[reader.parameterIndex(path)] ?? [])]).toEqual(value);
      }
    }
  });

  it("keeps a frame's views while it is read into again", () => {
    const reader = new FrameReader(manifest);
    const frame = reader.createFrame();
    const [first] = frame.rotations;
    reader.open(bytes.slice().buffer);
    reader.read(1, frame);
    expect(frame.rotations[0]).toBe(first);
    expect([...(first ?? [])]).toEqual(Object.values(frames[1]?.rotations ?? {})[0]?.flat());
  });

  it("says that a parameter is not there", () => {
    expect(new FrameReader(manifest).parameterIndex("lights/nowhere")).toBe(-1);
  });

  it.each([0, 1, 8, 185])("refuses a message of %i bytes, which are no whole frames", (length) => {
    expect(() => new FrameReader(manifest).open(bytes.slice(0, length).buffer)).toThrow(RangeError);
  });

  it("refuses another version", () => {
    const other = bytes.slice();
    other[0] = 2;
    expect(() => new FrameReader(manifest).open(other.buffer)).toThrow("version 2");
  });
});
