import { describe, expect, it } from "vitest";
import { wavOf } from "./mono-wav";

describe("wavOf", () => {
  it("writes a header and samples of 16 bits, louder ones as full scale", async () => {
    const blob = wavOf(new Float32Array([0, 0.5, -1, 2, -3]), 22_050);
    expect(blob.type).toBe("audio/wav");
    const view = new DataView(await blob.arrayBuffer());
    expect(view.byteLength).toBe(44 + 10);
    const text = (at: number, length: number): string =>
      String.fromCharCode(...new Uint8Array(view.buffer, at, length));
    expect([text(0, 4), text(8, 8), text(36, 4)]).toEqual(["RIFF", "WAVEfmt ", "data"]);
    expect([view.getUint32(4, true), view.getUint32(24, true), view.getUint32(28, true)]).toEqual([46, 22_050, 44_100]);
    expect([view.getUint16(20, true), view.getUint16(22, true), view.getUint16(34, true)]).toEqual([1, 1, 16]);
    expect(view.getUint32(40, true)).toBe(10);
    expect([0, 1, 2, 3, 4].map((index) => view.getInt16(44 + 2 * index, true))).toEqual([
      0, 16_384, -32_768, 32_767, -32_768,
    ]);
  });
});
