import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { TransportState } from "../generated/protocol";
import { SongPlayer, type SoundState } from "./song-player";

/** A value that an AudioParam was told, with its time. */
type Told = [method: string, value: number, at: number];

class HeldParam {
  readonly told: Told[] = [];
  setValueAtTime(value: number, at: number): void {
    this.told.push(["set", value, at]);
  }
  linearRampToValueAtTime(value: number, at: number): void {
    this.told.push(["ramp", value, at]);
  }
  setTargetAtTime(value: number, at: number): void {
    this.told.push(["target", value, at]);
  }
  cancelScheduledValues(): void {
    this.told.push(["cancel", 0, 0]);
  }
}

class HeldNode {
  readonly gain = new HeldParam();
  connect(next: HeldNode): HeldNode {
    return next;
  }
  disconnect(): void {
    return;
  }
}

class HeldSource extends HeldNode {
  readonly playbackRate = new HeldParam();
  readonly rate: number;
  loop = false;
  loopStart = 0;
  loopEnd = 0;
  started: [when: number, offset: number] | null = null;
  stopped = false;
  onended: (() => void) | null = null;

  constructor(_: unknown, options: { playbackRate: number }) {
    super();
    this.rate = options.playbackRate;
    sources.push(this);
  }
  start(when: number, offset: number): void {
    this.started = [when, offset];
  }
  stop(): void {
    this.stopped = true;
  }
}

const LATENCY = 0.04;
const SERVER_AHEAD = 1000;

let sources: HeldSource[];
let now: number;
let transport: TransportState;
let states: SoundState[];

/** A context whose clock is the page's, heard LATENCY later. */
const context = {
  state: "running" as AudioContextState,
  destination: new HeldNode(),
  outputLatency: LATENCY,
  baseLatency: 0.01,
  onstatechange: null as (() => void) | null,
  get currentTime() {
    return now;
  },
  createGain: () => new HeldNode(),
  decodeAudioData: () => Promise.resolve({ duration: 20 }),
  getOutputTimestamp: () => ({ contextTime: now - LATENCY, performanceTime: now * 1000 }),
  resume: vi.fn(() => Promise.resolve()),
};

function songTimeAt(pageTime: number): number {
  return transport.song_time_s + (pageTime + SERVER_AHEAD - transport.server_time_s) * transport.rate;
}

async function playing(change: Partial<TransportState> = {}): Promise<SongPlayer> {
  const time = { pageNow: () => now, songTimeAt };
  const player = new SongPlayer(time, (state) => states.push(state), context as unknown as AudioContext);
  await player.setSong(new ArrayBuffer(8));
  transport = { ...transport, playing: true, ...change };
  player.follow(transport);
  return player;
}

function lastSource(): HeldSource {
  const source = sources.at(-1);
  if (source === undefined) throw new Error("nothing was scheduled");
  return source;
}

beforeEach(() => {
  sources = [];
  states = [];
  now = 5;
  context.state = "running";
  context.resume.mockClear();
  transport = { playing: false, song_time_s: 3, server_time_s: SERVER_AHEAD + 5, rate: 1, loop: null, epoch: 1 };
  vi.stubGlobal("AudioBufferSourceNode", HeldSource);
  vi.stubGlobal("GainNode", HeldNode);
});
afterEach(() => vi.unstubAllGlobals());

describe("SongPlayer", () => {
  it("schedules the place in the song that is due when it will be heard", async () => {
    await playing();
    const [when = 0, offset = 0] = lastSource().started ?? [];
    const heardAt = when + LATENCY;
    expect(when).toBeGreaterThan(now);
    expect(offset).toBeCloseTo(songTimeAt(heardAt), 9);
  });

  it("plays at the rate, from the place that the rate leads to", async () => {
    await playing({ rate: 0.5 });
    const [when = 0, offset = 0] = lastSource().started ?? [];
    expect(lastSource().rate).toBe(0.5);
    expect(offset).toBeCloseTo(3 + (when + LATENCY - 5) * 0.5, 9);
  });

  it("tells what is heard, and that it is where it should be", async () => {
    const player = await playing();
    now = 8;
    expect(player.heardSongTime()).toBeCloseTo(6, 9);
    expect(player.soundAhead()).toBeCloseTo(0, 9);
  });

  it("stops on pause and starts anew on a seek, but plays on through an edit of the show", async () => {
    const player = await playing();
    now = 6;
    const edited = { ...transport, song_time_s: 4, server_time_s: SERVER_AHEAD + 6, epoch: 2 };
    player.follow((transport = edited));
    expect(sources).toHaveLength(1);
    player.follow((transport = { ...edited, song_time_s: 12, epoch: 3 }));
    expect(sources).toHaveLength(2);
    expect(sources[0]?.stopped).toBe(true);
    player.follow((transport = { ...transport, playing: false, epoch: 4 }));
    expect(sources[1]?.stopped).toBe(true);
    expect(player.heardSongTime()).toBeNull();
  });

  it("lets a moment be heard where the song rests, one after another, and none while it plays", async () => {
    const player = await playing();
    player.scrub(7);
    expect(sources).toHaveLength(1);
    player.follow((transport = { ...transport, playing: false, epoch: 2 }));
    player.scrub(7);
    player.scrub(8);
    expect(sources.slice(1).map(({ started }) => started)).toEqual([
      [now, 7],
      [now, 8],
    ]);
    player.scrub(20);
    expect(sources, "behind the song's end there is nothing to hear").toHaveLength(3);
  });

  it("loops sample by sample where the song is long enough", async () => {
    await playing({ loop: { start_s: 2, end_s: 9 } });
    expect(lastSource()).toMatchObject({ loop: true, loopStart: 2, loopEnd: 9 });
  });

  it("comes back after the silence between a short song's end and its loop's", async () => {
    const player = await playing({ loop: { start_s: 2, end_s: 25 } });
    expect(lastSource().loop).toBe(false);
    now = 22.5;
    lastSource().onended?.();
    player.check();
    expect(sources).toHaveLength(1);
    transport = { ...transport, song_time_s: 2.1, server_time_s: SERVER_AHEAD + now };
    player.check();
    expect(sources).toHaveLength(2);
  });

  it("levels sound that has drifted with one burst, and restarts what is far off", async () => {
    const player = await playing();
    transport = { ...transport, song_time_s: transport.song_time_s - 0.06 };
    for (now = 7; now < 7.5; now += 0.1) player.check();
    const [faster, back] = lastSource().playbackRate.told;
    expect(faster?.[1]).toBeCloseTo(0.97, 9);
    expect(back?.[1]).toBe(1);
    expect((back?.[2] ?? 0) - (faster?.[2] ?? 0)).toBeCloseTo(2, 3);
    transport = { ...transport, song_time_s: transport.song_time_s + 1 };
    for (now = 12; now < 12.5; now += 0.1) player.check();
    expect(sources).toHaveLength(2);
  });

  it("waits for the browser to let sound out, then starts at the right place", async () => {
    context.state = "suspended";
    await playing();
    expect(states).toEqual(["blocked"]);
    expect(sources).toHaveLength(0);
    expect(context.resume).toHaveBeenCalled();
    now = 9;
    context.state = "running";
    context.onstatechange?.();
    expect(states).toEqual(["blocked", "ready"]);
    const [when = 0, offset = 0] = lastSource().started ?? [];
    expect(offset).toBeCloseTo(songTimeAt(when + LATENCY), 9);
  });
});
