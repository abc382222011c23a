import { describe, expect, it } from "vitest";

import { type RemovableFile, blobDestination, fileDestination } from "./destination";

const bytes = (...values: number[]) => Uint8Array.from(values);

describe("a blob", () => {
  it("has what was written, and written over, where it was written", async () => {
    const destination = blobDestination("video/mp4");
    await destination.write({ data: bytes(1, 2, 3, 4), position: 0 });
    await destination.write({ data: bytes(5, 6), position: 4 });
    await destination.write({ data: bytes(20, 30), position: 1 });
    await destination.write({ data: bytes(60, 70, 80), position: 5 });
    await destination.write({ data: bytes(21), position: 1 });
    const film = await destination.finish();
    expect(film?.type).toBe("video/mp4");
    expect([...new Uint8Array((await film?.arrayBuffer()) ?? new ArrayBuffer())]).toEqual([
      1, 21, 30, 4, 5, 60, 70, 80,
    ]);
  });

  it("keeps no hold of what is written to it", async () => {
    const destination = blobDestination("video/mp4");
    const data = bytes(1, 2);
    await destination.write({ data, position: 0 });
    await destination.write({ data: data.subarray(0, 1), position: 0 });
    data.fill(9);
    const film = await destination.finish();
    expect([...new Uint8Array((await film?.arrayBuffer()) ?? new ArrayBuffer())]).toEqual([1, 2]);
  });

  it("has no holes", async () => {
    await expect(blobDestination("video/mp4").write({ data: bytes(1), position: 3 })).rejects.toThrow("before byte 3");
  });
});

describe("a file", () => {
  function file(): { handle: RemovableFile; calls: string[] } {
    const calls: string[] = [];
    const note = (name: string) => () => {
      calls.push(name);
      return Promise.resolve();
    };
    const stream = { write: note("write"), close: note("close"), abort: note("abort") };
    const handle = { createWritable: () => Promise.resolve(stream), remove: note("remove") };
    return { handle: handle as unknown as RemovableFile, calls };
  }

  it("is closed when it is whole", async () => {
    const { handle, calls } = file();
    const destination = await fileDestination(handle);
    await destination.write({ data: bytes(1), position: 0 });
    expect(await destination.finish()).toBeNull();
    expect(calls).toEqual(["write", "close"]);
  });

  it("is taken away when it is not wanted", async () => {
    const { handle, calls } = file();
    await (await fileDestination(handle)).discard();
    expect(calls).toEqual(["abort", "remove"]);
  });
});
