import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { TransportState } from "../generated/protocol";
import { SongPlayer, type SoundState } from "./song-player";
import { SegmentedSong, WholeSong, type SongSource } from "./song-source";
import { CROSSFADE_S } from "./voice";

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
  fftSize = 0;
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
  readonly buffer: unknown;
  started: [when: number, offset: number, duration: number] | null = null;
  stopped = false;
  onended: (() => void) | null = null;

  constructor(_: unknown, options: { playbackRate: number; buffer: unknown }) {
    super();
    this.rate = options.playbackRate;
    this.buffer = options.buffer;
    sources.push(this);
  }
  start(when: number, offset: number, duration: number): void {
    this.started = [when, offset, duration];
  }
  stop(): void {
    this.stopped = true;
  }
}

/** Digits to which a start is in time: it begins on a sample of the device. */
const GRID = 4;
const LATENCY = 0.04;
const SERVER_AHEAD = 1000;

let sources: HeldSource[];
let now: number;
let transport: TransportState;
let states: SoundState[];
let pictured: boolean;
/** Song seconds that are still counted in at any time. */
let countedIn: number;

/** A context whose clock is the page's, heard LATENCY later. */
const context = {
  state: "running" as AudioContextState,
  destination: new HeldNode(),
  sampleRate: 48000,
  outputLatency: LATENCY,
  baseLatency: 0.01,
  onstatechange: null as (() => void) | null,
  get currentTime() {
    return now;
  },
  createGain: () => new HeldNode(),
  createAnalyser: () => new HeldNode(),
  getOutputTimestamp: () => ({ contextTime: now - LATENCY, performanceTime: now * 1000 }),
  resume: vi.fn(() => Promise.resolve()),
};

function songTimeAt(pageTime: number): number {
  return transport.song_time_s + (pageTime + SERVER_AHEAD - transport.server_time_s) * transport.rate;
}

const whole = new WholeSong({ duration: 20 } as AudioBuffer);

function playing(change: Partial<TransportState> = {}, song: SongSource = whole): SongPlayer {
  const time = { pageNow: () => now, songTimeAt, pictured: () => pictured, countInAt: () => countedIn };
  const player = new SongPlayer(
    time,
    (state) => states.push(state),
    () => context as unknown as AudioContext,
  );
  player.setSong(song);
  transport = { ...transport, playing: true, ...change };
  player.follow(transport);
  return player;
}

type Start = [when: number, offset: number, duration: number];

/** When each source was started, from where in its buffer, and for how long. */
function starts(): Start[] {
  return sources.map(({ started }) => started ?? [0, 0, 0]);
}

function start(index: number): Start {
  return starts()[index] ?? [0, 0, 0];
}

function lastSource(): HeldSource {
  const source = sources.at(-1);
  if (source === undefined) throw new Error("nothing was scheduled");
  return source;
}

beforeEach(() => {
  sources = [];
  states = [];
  pictured = true;
  countedIn = 0;
  now = 5;
  context.state = "running";
  context.resume.mockClear();
  transport = {
    playing: false,
    song_time_s: 3,
    server_time_s: SERVER_AHEAD + 5,
    rate: 1,
    loop: null,
    count_in_s: 0,
    epoch: 1,
  };
  vi.stubGlobal("AudioBufferSourceNode", HeldSource);
  vi.stubGlobal("GainNode", HeldNode);
});
afterEach(() => vi.unstubAllGlobals());

describe("SongPlayer", () => {
  it("schedules the place in the song that is due when it will be heard", () => {
    playing();
    const [when = 0, offset = 0] = lastSource().started ?? [];
    const heardAt = when + LATENCY;
    expect(when).toBeGreaterThan(now);
    expect(offset).toBeCloseTo(songTimeAt(heardAt), GRID);
  });

  it("plays at the rate, from the place that the rate leads to", () => {
    playing({ rate: 0.5 });
    const [when = 0, offset = 0] = lastSource().started ?? [];
    expect(lastSource().rate).toBe(0.5);
    expect(offset).toBeCloseTo(3 + (when + LATENCY - 5) * 0.5, GRID);
  });

  it("tells what is heard, and that it is where it should be", () => {
    const player = playing();
    now = 8;
    expect(player.heardSongTime()).toBeCloseTo(6, GRID);
    expect(player.soundAhead()).toBeCloseTo(0, GRID);
  });

  it("stops on pause and starts anew on a seek, but plays on through an edit of the show", () => {
    const player = playing();
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

  it("lets a moment be heard where the song rests, one after another, and none while it plays", () => {
    const player = playing();
    player.scrub(7);
    expect(sources).toHaveLength(1);
    player.follow((transport = { ...transport, playing: false, epoch: 2 }));
    player.scrub(7);
    player.scrub(8);
    expect(
      starts()
        .slice(1)
        .map(([when, offset]) => [when, offset]),
    ).toEqual([
      [now, 7],
      [now, 8],
    ]);
    player.scrub(20);
    expect(sources, "behind the song's end there is nothing to hear").toHaveLength(3);
  });

  it("goes round a loop without a gap", () => {
    playing({ loop: { start_s: 2, end_s: 4, count_in_s: 0 } });
    const [first, second, third] = [start(0), start(1), start(2)];
    expect(second[0]).toBeCloseTo(first[0] + first[2], 9);
    expect(third[0]).toBeCloseTo(second[0] + 2, 9);
    expect([second[1], second[2]]).toEqual([2, 2]);
  });

  it("comes back after the silence between a short song's end and its loop's", () => {
    const player = playing({ loop: { start_s: 2, end_s: 25, count_in_s: 0 } });
    for (; now < 26; now += 0.1) player.check();
    const [when, offset] = start(0);
    expect(start(1)[0]).toBeCloseTo(when + 25 - offset, 9);
    expect(start(1)[1]).toBe(2);
  });

  it("begins where song time stands when the count-in is over", () => {
    countedIn = 3;
    const player = playing({ rate: 2, count_in_s: 3 });
    const [when, offset] = start(0);
    expect(offset).toBeCloseTo(songTimeAt(now + 0.06 + LATENCY), GRID);
    expect(when).toBeCloseTo(now + 0.06 + 1.5, GRID);
    expect(player.heardSongTime()).toBeNull();
    expect(player.soundAhead()).toBeNull();
  });

  it("leaves a loop's rounds apart by what is counted in", () => {
    playing({ loop: { start_s: 2, end_s: 4, count_in_s: 1 } });
    const [first, second] = starts();
    if (first === undefined || second === undefined) throw new Error("no second round was scheduled");
    expect(second[0] - first[0]).toBeCloseTo(first[2] + 1, GRID);
    expect(second.slice(1)).toEqual([2, 2]);
  });

  it("levels sound that has drifted with one burst, and restarts what is far off", () => {
    const player = playing();
    transport = { ...transport, song_time_s: transport.song_time_s - 0.06 };
    for (now = 7; now < 7.5; now += 0.1) player.check();
    const [faster, back] = lastSource().playbackRate.told;
    expect(faster?.[1]).toBeCloseTo(0.97, 9);
    expect(back?.[1]).toBe(1);
    expect((back?.[2] ?? 0) - (faster?.[2] ?? 0)).toBeCloseTo(2, 2);
    transport = { ...transport, song_time_s: transport.song_time_s + 1 };
    for (now = 12; now < 12.5; now += 0.1) player.check();
    expect(sources).toHaveLength(2);
  });

  it("waits for the picture of its place, but not for ever", () => {
    pictured = false;
    const player = playing();
    now = 5.4;
    player.check();
    expect(sources).toHaveLength(0);
    pictured = true;
    player.pictureCame();
    expect(sources).toHaveLength(1);
    expect(start(0)[1]).toBeCloseTo(songTimeAt(start(0)[0] + LATENCY), GRID);
    player.pictureCame();
    expect(sources).toHaveLength(1);
    pictured = false;
    player.follow((transport = { ...transport, song_time_s: 9, epoch: 2 }));
    expect(sources).toHaveLength(1);
    now = 6.5;
    player.check();
    expect(sources).toHaveLength(2);
  });

  it.each([0.2, -0.2])("asks for sound so much earlier as it comes late: %f s", (trim) => {
    const player = playing();
    now = 8;
    player.setTrim(trim);
    expect(sources).toHaveLength(2);
    const [when, offset] = start(1);
    expect(offset).toBeCloseTo(songTimeAt(when + LATENCY + trim), GRID);
    now = 9;
    expect(player.soundAhead()).toBeCloseTo(0, GRID);
    player.setTrim(trim);
    expect(sources, "nothing starts anew for nothing").toHaveLength(2);
  });

  it("puts right at once what is wrong after a sleep", () => {
    const player = playing();
    transport = { ...transport, song_time_s: transport.song_time_s + 0.1 };
    now = 8;
    player.wake();
    for (; now < 8.6; now += 0.1) player.check();
    expect(sources, "not by a burst of three seconds").toHaveLength(2);
    expect(player.soundAhead()).toBeCloseTo(0, GRID);
  });

  it("tells how far what is heard is from a picture, at the time at which the picture was seen", () => {
    const player = playing();
    now = 8;
    expect(player.heardAhead(6, 8)).toBeCloseTo(0, GRID);
    expect(player.heardAhead(5.9, 7.95)).toBeCloseTo(0.05, GRID);
  });

  it("waits for the browser to let sound out, then starts at the right place", () => {
    context.state = "suspended";
    playing();
    expect(states).toEqual(["blocked"]);
    expect(sources).toHaveLength(0);
    expect(context.resume).toHaveBeenCalled();
    now = 9;
    context.state = "running";
    context.onstatechange?.();
    expect(states).toEqual(["blocked", "ready"]);
    const [when = 0, offset = 0] = lastSource().started ?? [];
    expect(offset).toBeCloseTo(songTimeAt(when + LATENCY), GRID);
  });
});

describe("a song in segments", () => {
  const SEGMENT = 10;
  const OVERLAP = 0.1;
  let asked: number[];
  let come: Map<number, (buffer: AudioBuffer) => void>;
  let player: SongPlayer;

  function segmented(): SegmentedSong {
    asked = [];
    come = new Map();
    return new SegmentedSong({
      duration: 65,
      segmentLength: SEGMENT,
      overlap: OVERLAP,
      load: (segment) => {
        asked.push(segment);
        return new Promise((resolve) => come.set(segment, resolve));
      },
      came: () => player.segmentCame(),
      failed: (error) => {
        throw error;
      },
    });
  }

  async function arrives(segment: number): Promise<void> {
    come.get(segment)?.({ duration: SEGMENT + 2 * OVERLAP, segment } as unknown as AudioBuffer);
    await Promise.resolve();
    await Promise.resolve();
  }

  it("asks for what is heard now, then for what follows, and a seek's segment before all else", async () => {
    player = playing({}, segmented());
    expect(asked).toEqual([0]);
    await arrives(0);
    await arrives(1);
    expect(asked).toEqual([0, 1, 2]);
    player.follow((transport = { ...transport, song_time_s: 52, epoch: 2 }));
    await arrives(2);
    expect(asked.slice(3)).toEqual([5]);
  });

  it("says that the sound comes, and begins where the song is by then", async () => {
    player = playing({}, segmented());
    expect(states).toEqual(["coming"]);
    expect(sources).toHaveLength(0);
    now = 7;
    await arrives(0);
    expect(states).toEqual(["coming", "ready"]);
    const [when = 0, offset = 0] = lastSource().started ?? [];
    expect(offset).toBeCloseTo(songTimeAt(when + LATENCY) + OVERLAP, GRID);
  });

  it("fades each segment into the next at one place of the song", async () => {
    player = playing({ song_time_s: 8 }, segmented());
    await arrives(0);
    await arrives(1);
    expect(sources.map(({ buffer }) => (buffer as { segment: number }).segment)).toEqual([0, 1]);
    const [when, offset, duration] = start(0);
    const second = start(1);
    expect(offset + duration, "to half the fade behind its end").toBeCloseTo(SEGMENT + OVERLAP + CROSSFADE_S / 2, 9);
    expect(second[1], "from half the fade before its begin").toBeCloseTo(OVERLAP - CROSSFADE_S / 2, 9);
    const boundary = when + (SEGMENT + OVERLAP - offset);
    expect(second[0]).toBeCloseTo(boundary - CROSSFADE_S / 2, 9);
    const samples = (second[0] - when) * context.sampleRate;
    expect(Math.abs(samples - Math.round(samples)), "a whole number of samples later").toBeLessThan(1e-6);
  });

  it("is silent where a segment is late, says so, and goes on when it comes", async () => {
    player = playing({ song_time_s: 8 }, segmented());
    await arrives(0);
    for (; now < 9; now += 0.1) player.check();
    expect(states).toEqual(["coming", "ready", "coming"]);
    expect(player.heardSongTime()).toBeNull();
    await arrives(1);
    expect(states.at(-1)).toBe("ready");
    now += 1;
    expect(player.soundAhead()).toBeCloseTo(0, GRID);
  });

  it("keeps few segments decoded, however long it plays", async () => {
    player = playing({}, segmented());
    for (let segment = 0; segment < 7; segment += 1) {
      await arrives(segment);
      player.follow((transport = { ...transport, song_time_s: 10 * segment + 9, epoch: segment + 2 }));
    }
    expect(player.held).toBeLessThan(6.5 * (SEGMENT + 2 * OVERLAP));
    expect(player.held).toBeGreaterThan(SEGMENT);
  });

  it("takes back what has not begun when the rate changes, and places it anew", async () => {
    player = playing({ song_time_s: 8 }, segmented());
    await arrives(0);
    await arrives(1);
    transport = { ...transport, song_time_s: transport.song_time_s - 0.03 };
    for (now = 5.7; now < 6.2; now += 0.1) player.check();
    expect(sources).toHaveLength(3);
    expect(sources[1]?.stopped).toBe(true);
    const later = start(2)[0] - start(1)[0];
    expect(start(2)[1]).toBeCloseTo(start(1)[1], 9);
    expect(later, "as much later as a slower second makes it").toBeGreaterThan(0.02);
    expect(later).toBeLessThan(0.03);
  });
});
