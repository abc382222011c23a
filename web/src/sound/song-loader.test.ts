import { afterEach, expect, it, vi } from "vitest";
import { ProblemError, type ReinaApi } from "../connection";
import type { SongSegments, SongState } from "../generated/protocol";
import { AnotherSoundError, loadSegment } from "./song-loader";

const SEGMENTS: SongSegments = {
  href: "/api/v1/sessions/s/song/segments/first",
  media_type: "audio/ogg",
  count: 4,
  segment_s: 10,
  overlap_s: 0.1,
  song_s: 38,
};
const STATE: SongState = {
  href: "/api/v1/sessions/s/song?v=first",
  status: "rendering",
  source: "rendered",
  media_type: "audio/flac",
  progress: 0.5,
  segments: SEGMENTS,
};

/** A server that answers one after the other; a status alone is a refusal. */
function server(answers: (Response | number)[]): ReinaApi {
  const request = (): Promise<Response> => {
    const answer = answers.shift() ?? 500;
    if (typeof answer !== "number") return Promise.resolve(answer);
    return Promise.reject(new ProblemError({ status: answer, title: "no", detail: "", errors: [] }));
  };
  return { request } as unknown as ReinaApi;
}

const told = (state: Partial<SongState>): Response =>
  new Response(JSON.stringify({ ...STATE, ...state }), { status: 202 });
const asked = (answers: (Response | number)[]): Promise<ArrayBuffer> => {
  const bytes = loadSegment(server(answers), SEGMENTS, 3, new AbortController().signal);
  bytes.catch(() => undefined);
  return bytes;
};

afterEach(() => vi.useRealTimers());

it("waits for a segment that is not rendered yet", async () => {
  vi.useFakeTimers();
  const bytes = asked([told({}), told({ progress: 0.7 }), new Response(new Uint8Array([1, 2, 3]))]);
  await vi.advanceTimersByTimeAsync(500);
  expect(new Uint8Array(await bytes)).toEqual(new Uint8Array([1, 2, 3]));
});

it.each([
  ["another sound is being made", told({ segments: { ...SEGMENTS, href: "/api/v1/sessions/s/song/segments/second" } })],
  ["another sound is being planned", told({ segments: null })],
  ["this one is gone", 410],
])("says that there is another sound where %s", async (_, answer) => {
  await expect(asked([answer])).rejects.toBeInstanceOf(AnotherSoundError);
});

it("says why there will be none", async () => {
  await expect(asked([502])).rejects.toMatchObject({ status: 502 });
  await expect(asked([told({ status: "failed" })])).rejects.toMatchObject({ status: 502 });
});
