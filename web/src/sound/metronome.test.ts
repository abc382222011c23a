import { beforeEach, describe, expect, it, vi } from "vitest";
import { clicksBetween, countInClicks, type Click } from "../state/beats";
import { Metronome } from "./metronome";
import { PlaybackPath } from "./playback-path";

/** What clicked: when, and how high. */
let clicked: { when: number; hertz: number; stopped: boolean }[];
let now: number;

class HeldParam {
  value = 0;
  readonly setValueAtTime = vi.fn();
  readonly linearRampToValueAtTime = vi.fn();
  readonly setTargetAtTime = vi.fn();
}

class HeldNode {
  readonly gain = new HeldParam();
  onended: (() => void) | null = null;
  connect<T>(next: T): T {
    return next;
  }
  readonly disconnect = vi.fn();
}

class HeldOscillator extends HeldNode {
  readonly #hertz: number;
  #click: { when: number; hertz: number; stopped: boolean } | null = null;
  constructor(_: unknown, { frequency }: { frequency: number }) {
    super();
    this.#hertz = frequency;
  }
  start(when: number): void {
    this.#click = { when, hertz: this.#hertz, stopped: false };
    clicked.push(this.#click);
  }
  stop(when?: number): void {
    if (when === undefined && this.#click !== null) this.#click.stopped = true;
  }
}

const context = {
  destination: new HeldNode(),
  createGain: () => new HeldNode(),
  get currentTime() {
    return now;
  },
} as unknown as AudioContext;

const march = {
  tempi: [{ onset_beats: 0, onset_s: 0, bpm: 120 }],
  metres: [{ onset_beats: 0, onset_s: 0, numerator: 4, denominator: 4 }],
  bar_lines_s: [0, 2, 4, 6, 8, 10],
};

function metronomeOn(pathNow: () => PlaybackPath | null): Metronome {
  return new Metronome(() => context, {
    pathNow,
    clicksIn: ({ from, to, countsTo }): readonly Click[] =>
      countsTo === null
        ? clicksBetween(march, from, to, "beats")
        : countInClicks(march, countsTo, countsTo - from, "beats").filter(({ songTime }) => songTime < to - 1e-6),
  });
}

let path: PlaybackPath | null;

/** Check every tenth of a second, as the page does, with some of its unsteadiness. */
function runUntil(metronome: Metronome, end: number, motion: unknown = 1): void {
  for (let turn = 0; now < end; turn += 1) {
    metronome.check(motion);
    now += 0.1 + 0.03 * Math.sin(turn);
  }
}

function times(): number[] {
  return clicked.filter(({ stopped }) => !stopped).map(({ when }) => Math.round(when * 1e4) / 1e4);
}

beforeEach(() => {
  clicked = [];
  now = 100;
  vi.stubGlobal("OscillatorNode", HeldOscillator);
  vi.stubGlobal("GainNode", HeldNode);
});

describe("Metronome", () => {
  it.each([0.25, 1, 2])("clicks every beat once, at its time, at rate %d", (rate) => {
    path = new PlaybackPath(100.1, 2, rate, null);
    runUntil(
      metronomeOn(() => path),
      100.1 + 4 / rate,
    );
    const wanted = [0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5].map((after) => Math.round((100.1 + after / rate) * 1e4) / 1e4);
    expect(times().slice(0, 8)).toEqual(wanted);
    expect(clicked.slice(0, 5).map(({ hertz }) => hertz)).toEqual([1760, 1175, 1175, 1175, 1760]);
  });

  it("counts in, and clicks on through the rounds of a loop", () => {
    path = new PlaybackPath(102.1, 4, 1, { start_s: 4, end_s: 6, count_in_s: 2 });
    runUntil(
      metronomeOn(() => path),
      108,
    );
    const wanted = Array.from({ length: 15 }, (_, beat) => Math.round((100.1 + beat / 2) * 1e4) / 1e4);
    expect(times().slice(0, 15)).toEqual(wanted);
    expect(clicked.map(({ hertz }, beat) => (hertz === 1760 ? beat : -1)).filter((beat) => beat >= 0)).toEqual([
      0, 4, 8, 12, 16,
    ]);
  });

  it("keeps to one click a beat while what is known of the clock wavers", () => {
    const metronome = metronomeOn(() => new PlaybackPath(now, 2 + (now - 100) + 0.004 * Math.sin(40 * now), 1, null));
    path = null;
    runUntil(metronome, 104);
    const wanted = [0.5, 1, 1.5, 2, 2.5, 3, 3.5].map((after) => 100 + after);
    const heard = times().filter((when) => when > 100.2 && when < 103.8);
    expect(heard).toHaveLength(wanted.length);
    heard.forEach((when, at) => expect(Math.abs(when - (wanted[at] ?? 0))).toBeLessThan(0.01));
  });

  it("takes back what was scheduled when the song moves otherwise", () => {
    path = new PlaybackPath(100, 1.8, 1, null);
    const metronome = metronomeOn(() => path);
    metronome.check(1);
    expect(times()).toEqual([100.2, 100.7, 101.2]);
    now = 100.1;
    path = new PlaybackPath(100.1, 5.95, 1, null);
    metronome.check(2);
    expect(times()).toEqual([100.15, 100.65, 101.15, 101.65]);
    path = null;
    metronome.check(2);
    expect(times()).toEqual([]);
  });

  it("schedules as far ahead as timers may come late", () => {
    path = new PlaybackPath(100, 1.8, 1, null);
    metronomeOn(() => path).check(1);
    expect(times()).toEqual([100.2, 100.7, 101.2]);
  });
});
