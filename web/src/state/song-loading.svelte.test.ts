import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { ProblemError, type ReinaApi } from "../connection";
import type { SongState } from "../generated/protocol";
import type { SongPlayer } from "../sound";
import type { SongSource } from "../sound/song-source";
import type { PartSound } from "./part-sound.svelte";
import { SongLoading, type SongNeeds } from "./song-loading.svelte";

const HEARD = { apart: false, player: 0, semitones: 0 };

function song(name: string): SongState {
  return {
    href: `/song/${name}`,
    status: "ready",
    source: "rendered",
    media_type: "audio/flac",
    progress: 1,
    segments: {
      href: `/song/segments/${name}`,
      media_type: "audio/ogg",
      count: 4,
      segment_s: 10,
      overlap_s: 0.1,
      song_s: 38,
    },
  };
}

/** A server that has one sound; what is asked of any other is gone. */
class Server {
  present = "first";
  readonly asked: string[] = [];
  readonly api = {
    sessionPath: (_: string, path: string) => `/${path}`,
    request: (_: string, href: string): Promise<Response> => {
      this.asked.push(href);
      if (href === "/song/state") return Promise.resolve(new Response(JSON.stringify(song(this.present))));
      if (href.startsWith(`/song/segments/${this.present}/`)) return Promise.resolve(new Response(new ArrayBuffer(8)));
      return Promise.reject(new ProblemError({ status: 410, title: "gone", detail: "", errors: [] }));
    },
  } as unknown as ReinaApi;
}

function loading(server: Server): { song: SongLoading; taken: SongSource[]; silent: () => void } {
  const taken: SongSource[] = [];
  const player = {
    setBalance: () => undefined,
    setSong: () => undefined,
    segmentCame: () => undefined,
    goOverTo: (source: SongSource) => taken.push(source),
    decode: () => Promise.resolve({ duration: 10 }),
  } as unknown as SongPlayer;
  const silent = vi.fn();
  const needs: SongNeeds = {
    api: server.api,
    session: "s",
    player,
    isRecording: () => false,
    decoded: () => undefined,
    silent,
    fail: () => undefined,
  };
  const partSound = { balance: 0, hearing: () => HEARD, giveUp: () => undefined } as unknown as PartSound;
  return { song: new SongLoading(needs, partSound, () => 0), taken, silent };
}

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

it("goes over to another sound whose news has not come, without an error", async () => {
  const server = new Server();
  const { song: heard, taken, silent } = loading(server);
  heard.load(song("first"));
  await vi.advanceTimersByTimeAsync(10);
  expect(taken).toHaveLength(1);
  server.present = "second";
  taken[0]?.want([2]);
  await vi.advanceTimersByTimeAsync(500);
  expect(taken).toHaveLength(2);
  taken[1]?.want([2]);
  await vi.advanceTimersByTimeAsync(10);
  expect(server.asked).toEqual(["/song/segments/first/2", "/song/state", "/song/segments/second/2"]);
  expect(taken[1]?.at(2)).not.toBeNull();
  expect(heard.error).toBeNull();
  expect(silent).not.toHaveBeenCalled();
});

it("asks for nothing once it is closed", async () => {
  const server = new Server();
  const { song: heard, taken } = loading(server);
  heard.close();
  heard.load(song("first"));
  await vi.advanceTimersByTimeAsync(500);
  taken[0]?.want([0]);
  expect(server.asked).toEqual([]);
});
