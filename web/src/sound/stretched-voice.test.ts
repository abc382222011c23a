import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { Loop } from "../generated/protocol";
import { PitchKeeper } from "./pitch-keeper";
import { PlaybackPath } from "./playback-path";
import type { SongSource } from "./song-source";
import { StretchedVoice } from "./stretched-voice";
import type { StretchChange, Stretcher } from "./stretcher";

const RATE = 1000;
const SEGMENT = 10;
const OVERLAP = 0.1;
const DURATION = 25;

/** Samples that say their own place in the song, in seconds. */
function segment(number: number): AudioBuffer {
  const first = number * SEGMENT - OVERLAP;
  const last = Math.min((number + 1) * SEGMENT, DURATION) + OVERLAP;
  const samples = Float32Array.from({ length: Math.round((last - first) * RATE) }, (_, at) => first + at / RATE);
  return { sampleRate: RATE, numberOfChannels: 1, length: samples.length, getChannelData: () => samples } as never;
}

class Row implements Stretcher {
  readonly node = { connect: (to: unknown) => to, disconnect: vi.fn() } as never;
  samples: number[] = [];
  readonly told: StretchChange[] = [];
  schedule(change: StretchChange): void {
    this.told.push(change);
  }
  add([first]: readonly Float32Array<ArrayBuffer>[]): void {
    this.samples.push(...(first ?? []));
  }
  begin(): void {
    this.samples = [];
  }
  /** The place in the song that is heard at a context time, by what it was told. */
  heardAt(time: number): number {
    const [start] = this.told;
    let [at, input, rate] = [start?.output ?? 0, start?.input ?? 0, start?.rate ?? 0];
    for (const change of this.told.slice(1)) {
      if (change.output > time || change.rate === undefined) continue;
      [at, input, rate] = [change.output, input + (change.output - at) * rate, change.rate];
    }
    return this.samples[Math.round((input + (time - at) * rate) * RATE)] ?? NaN;
  }
}

class HeldGain {
  readonly gain = {
    setValueAtTime: vi.fn(),
    linearRampToValueAtTime: vi.fn(),
    cancelScheduledValues: vi.fn(),
    setTargetAtTime: vi.fn(),
  };
  connect(to: unknown): unknown {
    return to;
  }
  disconnect(): void {
    return;
  }
}

let now: number;
let held: Map<number, AudioBuffer>;
let row: Row;
const context = {
  sampleRate: RATE,
  get currentTime() {
    return now;
  },
} as BaseAudioContext;

const song = {
  duration: DURATION,
  segmentLength: SEGMENT,
  overlap: OVERLAP,
  at: (number: number) => held.get(number) ?? null,
} as unknown as SongSource;

function voice(position: number, rate: number, loop: Loop | null = null): StretchedVoice {
  const path = new PlaybackPath(now + 0.15, position, rate, loop);
  return new StretchedVoice(context, song, row, {} as AudioNode, { path, position, rate, loop }, 0.012);
}

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("GainNode", HeldGain);
  now = 100;
  row = new Row();
  held = new Map([0, 1, 2].map((number) => [number, segment(number)]));
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("StretchedVoice", () => {
  it.each([0.25, 0.5, 0.75, 1.25, 2])("is at every moment where its path says, at %s of the tempo", (rate) => {
    const played = voice(8.3, rate);
    for (let step = 0; step < 60 && !played.isOver; step += 1) {
      now += 0.1;
      played.extend();
      if (now < 100.15) continue;
      expect(row.heardAt(now)).toBeCloseTo(played.path.positionAt(now), 2);
    }
  });

  it("goes on over a segment's end without a gap, and round a loop", () => {
    const loop = { start_s: 9, end_s: 11, count_in_s: 0 };
    const played = voice(9.5, 0.5, loop);
    for (let step = 0; step < 100; step += 1) {
      now += 0.1;
      played.extend();
      const place = played.path.positionAt(now);
      // The sample beside a loop's end may be either side of it.
      if (now > 100.2 && place > 9.01 && place < 10.99) expect(row.heardAt(now)).toBeCloseTo(place, 2);
    }
  });

  it("keeps to its path through a burst, told its end once the burst has begun", () => {
    const played = voice(2, 0.5);
    played.changeRate(101, 102, 0.515);
    expect(row.told.at(-1)).toEqual({ output: 101, rate: 0.515 });
    now = 101.6;
    vi.advanceTimersByTime(1600);
    expect(row.told.at(-1)).toEqual({ output: 102, rate: 0.5 });
    for (const time of [100.9, 101.5, 102.5]) expect(row.heardAt(time)).toBeCloseTo(played.path.positionAt(time), 2);
  });

  it("waits for a segment that is not there, and is over where it comes too late", () => {
    held.delete(1);
    const played = voice(9, 0.5);
    expect(played.until).toBeCloseTo(100.15 + 2, 6);
    held.set(1, segment(1));
    played.extend();
    expect(played.until).toBeGreaterThan(104);
    held.clear();
    now = played.until + 0.1;
    expect(played.isOver).toBe(true);
  });

  it("leaves no change behind when it ends", () => {
    const played = voice(2, 0.5);
    played.changeRate(101, 102, 0.515);
    played.stop(0.012);
    vi.advanceTimersByTime(5000);
    expect(row.told.at(-1)).toMatchObject({ active: false });
  });
});

describe("PitchKeeper", () => {
  const secure = { audioWorklet: {} } as BaseAudioContext;

  it("loads when it is asked first, and says when it is there", async () => {
    const ready = vi.fn();
    const keeper = new PitchKeeper(secure, ready, () => Promise.resolve(row));
    expect(keeper.stretcher(2)).toBeNull();
    await vi.waitFor(() => expect(ready).toHaveBeenCalledOnce());
    expect(keeper.stretcher(2)).toBe(row);
    expect(keeper.stretcher(4), "for other channels another").toBeNull();
  });

  it("says that the pitch is lost where the browser has no worklets, or the file cannot be had", async () => {
    const make = vi.fn(() => Promise.reject(new Error("404")));
    const bare = new PitchKeeper({} as BaseAudioContext, () => undefined, make);
    expect([bare.keepsPitch, bare.stretcher(2)]).toEqual([false, undefined]);
    expect(make).not.toHaveBeenCalled();
    const ready = vi.fn();
    const failing = new PitchKeeper(secure, ready, make);
    expect([failing.keepsPitch, failing.stretcher(2)]).toEqual([true, null]);
    await vi.waitFor(() => expect(ready).toHaveBeenCalledOnce());
    expect([failing.keepsPitch, failing.stretcher(2)]).toEqual([false, undefined]);
  });
});
