import { describe, expect, it, vi } from "vitest";

import type { ReinaApi } from "../../connection";
import { CurveReader } from "./curves.svelte";
import type { ShowTrack } from "./show-document";

const PATH = "lights/key/intensity";
const CURVES = {
  times_s: [2, 3],
  curves: [{ parameter: PATH, keys: { values: [[1, 2]], jumps: [] }, with_events: { values: [[5, 6]], jumps: [] } }],
};

function reader() {
  const request = vi.fn<ReinaApi["request"]>(() => Promise.resolve(new Response(JSON.stringify(CURVES))));
  const sessionPath = (session: string, below = "") => `/${session}/${below}`;
  return { request, reader: new CurveReader({ request, sessionPath }, "id", "token") };
}

function trackOf(keys: number): ShowTrack {
  const keyframes = Array.from({ length: keys }, (_, number) => ({ key: `k${number}`, time: number, value: 1 }));
  return { parameter: PATH, keyframes };
}

describe("a track's curve as it would be", () => {
  it("is asked for by sending the track", async () => {
    const { request, reader: curves } = reader();
    expect((await curves.preview(trackOf(10), 2, 3, 2))?.values).toEqual([[5, 6]]);
    expect(request.mock.calls[0]?.[0]).toBe("POST");
  });

  it("is not asked for where the track is longer than the server takes", async () => {
    const { request, reader: curves } = reader();
    expect(await curves.preview(trackOf(20_000), 2, 3, 2)).toBeNull();
    expect(request).not.toHaveBeenCalled();
  });
});

it("reads what keyframes alone give, without their answer to the music", async () => {
  const { request, reader: curves } = reader();
  expect((await curves.ofKeys(PATH, 2, 3, 2))?.values).toEqual([[1, 2]]);
  const [method, address] = request.mock.calls[0] ?? [];
  expect(method).toBe("GET");
  expect(address).toContain(`parameter=${encodeURIComponent(PATH)}`);
});
