import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { HEADER_SIZE, type Manifest } from "../generated/protocol";
import { BLOCK_FRAMES, isCut, revisionOf, unpackBlock } from "./packed-block";

const golden = new URL("../../../tests/golden/", import.meta.url);
const { manifest } = JSON.parse(readFileSync(new URL("frame_v1.json", golden), "utf8")) as { manifest: Manifest };

function bytesOf(name: string): ArrayBuffer {
  return new Uint8Array(readFileSync(new URL(name, golden))).buffer;
}

/** The floats of the golden frames of a form, behind their headers. */
function framesOf(form: string): Float32Array[] {
  const bytes = bytesOf(`block_v1_${form}_frames.bin`);
  const { frame_size } = manifest;
  return Array.from(
    { length: BLOCK_FRAMES },
    (_, frame) => new Float32Array(bytes, frame * frame_size + HEADER_SIZE, (frame_size - HEADER_SIZE) / 4),
  );
}

/** The golden block with some of its bytes written over. */
function changed(at: number, ...bytes: number[]): ArrayBuffer {
  const block = bytesOf("block_v1_packed.bin");
  new Uint8Array(block).set(bytes, at);
  return block;
}

describe("unpackBlock", () => {
  it.each(["packed", "lossless"])("reads the header of the golden block, %s", async (form) => {
    const bytes = bytesOf(`block_v1_${form}.bin`);
    const block = await unpackBlock(manifest, bytes);
    expect(block).toMatchObject({ number: 40, revision: "0123456789abcdef" });
    expect(revisionOf(bytes)).toBe("0123456789abcdef");
    const cuts = Array.from({ length: BLOCK_FRAMES }, (_, frame) => frame).filter((frame) => isCut(block, frame));
    expect(cuts).toEqual([0, 13, 59]);
  });

  it("gives the golden frames to a millionth", async () => {
    const { frames } = await unpackBlock(manifest, bytesOf("block_v1_packed.bin"));
    const expected = framesOf("packed");
    expect(frames).toHaveLength(BLOCK_FRAMES);
    const furthest = frames.map((floats, frame) =>
      Math.max(...floats.map((value, i) => Math.abs(value - (expected[frame]?.[i] ?? NaN)))),
    );
    expect(Math.max(...furthest)).toBeLessThanOrEqual(1e-6);
  });

  it("gives the lossless ones bit for bit", async () => {
    const { frames } = await unpackBlock(manifest, bytesOf("block_v1_lossless.bin"));
    expect(frames.map((floats) => [...floats])).toEqual(framesOf("lossless").map((floats) => [...floats]));
  });

  it.each([
    ["no block", new ArrayBuffer(96), /96 bytes are no packed block/],
    ["less than a header", changed(0).slice(0, 31), /31 bytes are no packed block/],
    ["another version", changed(2, 9), /version 9; this page reads version 1/],
    ["frames of another size", changed(24, 96, 0, 0, 0), /of 96 bytes, and not of 184/],
    ["damaged", changed(200, 0, 0, 0, 0), /damaged/],
    ["cut off", changed(0).slice(0, -20), /damaged/],
  ])("refuses what is %s", async (_, bytes, words) => {
    const unpacking = unpackBlock(manifest, bytes);
    await expect(unpacking).rejects.toThrow(RangeError);
    await expect(unpacking).rejects.toThrow(words);
  });

  it("refuses a block of other columns", async () => {
    const [player, ...others] = manifest.skeletons;
    if (player === undefined) throw new Error("the golden manifest has a skeleton");
    const fewer = { ...manifest, skeletons: [{ ...player, joints: player.joints.slice(1) }, ...others] };
    await expect(unpackBlock(fewer, bytesOf("block_v1_packed.bin"))).rejects.toThrow(/not as long as its columns/);
  });
});
