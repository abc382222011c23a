import { describe, expect, it, vi } from "vitest";

import { ReinaApi } from "../connection";
import { SAMPLE_MANIFEST, encodeSampleFrames } from "../connection/sample-frames";
import type { Hello } from "../generated/protocol";
import { readFrames } from "./frames";

const HELLO = SAMPLE_MANIFEST as Hello;

/** A server that answers with the frames of each span that it is asked for. */
function served(asked: string[], fault: (request: number) => Response | Error | null = () => null): ReinaApi {
  return new ReinaApi("/api", (path) => {
    const { searchParams } = new URL(path instanceof Request ? path.url : path, "http://server");
    asked.push(searchParams.toString());
    const wrong = fault(asked.length);
    if (wrong instanceof Error) return Promise.reject(wrong);
    if (wrong !== null) return Promise.resolve(wrong);
    const [start, end, fps] = ["start_s", "end_s", "fps"].map((name) => Number(searchParams.get(name)));
    const [first, beyond] = [Math.ceil((start ?? 0) * (fps ?? 0) - 1e-6), Math.ceil((end ?? 0) * (fps ?? 0) - 1e-6)];
    const frames = Array.from({ length: beyond - first }, (_, place) => ({ index: first + place, due: 0 }));
    return Promise.resolve(new Response(encodeSampleFrames(...frames)));
  });
}

async function indices(api: ReinaApi, first: number, end: number, signal = new AbortController().signal) {
  const found: number[] = [];
  for await (const frame of readFrames(api, "s", HELLO, { first, end, fps: 60 }, signal)) found.push(frame.index);
  return found;
}

describe("the frames of a film", () => {
  it("come piece by piece, all of them, in order", async () => {
    const asked: string[] = [];
    const found = await indices(served(asked), 100, 700);
    expect(found).toEqual(Array.from({ length: 600 }, (_, place) => 100 + place));
    expect(asked).toHaveLength(3);
    expect(asked[0]).toBe(`start_s=${100 / 60}&end_s=${340 / 60}&fps=60`);
  });

  it("are asked for one piece ahead, and no more", async () => {
    const asked: string[] = [];
    const frames = readFrames(
      served(asked),
      "s",
      HELLO,
      { first: 0, end: 2400, fps: 60 },
      new AbortController().signal,
    );
    await frames.next();
    expect(asked).toHaveLength(2);
    for (let number = 0; number < 239; number++) await frames.next();
    expect(asked).toHaveLength(2);
    await frames.next();
    expect(asked).toHaveLength(3);
  });

  it("are asked for again when the server is away for a moment", async () => {
    vi.useFakeTimers();
    const found = indices(
      served([], (request) => (request === 2 ? new TypeError("Failed to fetch") : null)),
      0,
      480,
    );
    await vi.runAllTimersAsync();
    vi.useRealTimers();
    expect(await found).toHaveLength(480);
  });

  it("are none when the server refuses", async () => {
    const refusal = () => new Response(JSON.stringify({ title: "There is no such session" }), { status: 404 });
    await expect(indices(served([], refusal), 0, 60)).rejects.toThrow("There is no such session");
  });

  it("are no others than those that were asked for", async () => {
    const short = () => new Response(encodeSampleFrames({ index: 0, due: 0 }));
    await expect(indices(served([], short), 0, 60)).rejects.toThrow("60 that were asked for");
  });

  it("end at once when the film is called off", async () => {
    const cancel = new AbortController();
    const frames = readFrames(served([]), "s", HELLO, { first: 0, end: 60, fps: 60 }, cancel.signal);
    await frames.next();
    cancel.abort();
    await expect(frames.next()).rejects.toThrow("abort");
  });
});
