import { beforeEach, describe, expect, it, vi } from "vitest";
import { AudioOutput } from "./audio-output";

/** A device under the test's hand: its time goes with the page's while it is neither stopped nor stuck. */
class HeldContext {
  state = "running";
  stuck = false;
  refuses = false;
  readonly destination = {};
  readonly sampleRate = 48000;
  readonly outputLatency = 0.02;
  readonly baseLatency = 0.01;
  onstatechange: (() => void) | null = null;
  resumed = 0;
  #time = 0;
  #at = now;

  get currentTime(): number {
    if (this.state === "running" && !this.stuck) this.#time += now - this.#at;
    this.#at = now;
    return this.#time;
  }
  createGain(): object {
    return { gain: { setTargetAtTime: (gain: number) => gains.push(gain) }, connect: () => undefined };
  }
  createAnalyser(): object {
    return { connect: () => undefined };
  }
  getOutputTimestamp(): AudioTimestamp {
    return { contextTime: this.currentTime - 0.02, performanceTime: now * 1000 };
  }
  resume(): Promise<void> {
    this.resumed += 1;
    if (this.refuses) return Promise.reject(new DOMException("the system says no", "InvalidStateError"));
    this.state = "running";
    return Promise.resolve();
  }
  close(): Promise<void> {
    this.state = "closed";
    return Promise.resolve();
  }
}

let now: number;
let made: HeldContext[];
let gains: number[];
const changed = vi.fn();

function output(): AudioOutput {
  return new AudioOutput(
    () => {
      const context = new HeldContext();
      made.push(context);
      return context as unknown as AudioContext;
    },
    () => now,
    changed,
  );
}

function looks(out: AudioOutput, seconds: number): void {
  for (const until = now + seconds; now < until; now += 0.1) out.look();
}

function held(place: number): HeldContext {
  const context = made[place];
  if (context === undefined) throw new Error(`no context ${place} was made`);
  return context;
}

beforeEach(() => {
  now = 10;
  made = [];
  gains = [];
  changed.mockClear();
});

describe("AudioOutput", () => {
  it("leaves a device alone that plays", () => {
    looks(output(), 20);
    expect(made).toHaveLength(1);
    expect(changed).not.toHaveBeenCalled();
  });

  it.each(["stuck", "closed"])("makes another context within two seconds where the old one is %s", (fault) => {
    const out = output();
    out.setGain(0.25);
    looks(out, 1);
    if (fault === "stuck") held(0).stuck = true;
    else held(0).state = "closed";
    looks(out, 1.5);
    expect(made).toHaveLength(2);
    expect(out.context).toBe(held(1));
    expect(changed).toHaveBeenLastCalledWith(true);
    expect(gains.at(-1), "as loud as before").toBe(0.25);
    looks(out, 20);
    expect(made).toHaveLength(2);
  });

  it("asks a system that took the sound away until it gives it back", async () => {
    const out = output();
    looks(out, 1);
    const context = held(0);
    context.state = "interrupted";
    context.refuses = true;
    looks(out, 10);
    await Promise.resolve();
    expect(made, "a call may last").toHaveLength(1);
    expect(context.resumed).toBeGreaterThan(10);
    context.refuses = false;
    looks(out, 1);
    expect(context.state).toBe("running");
  });

  it("asks again what was suspended from outside, and makes another context where that does not help", () => {
    const out = output();
    looks(out, 1);
    held(0).state = "suspended";
    looks(out, 0.2);
    expect(held(0).state).toBe("running");
    held(0).state = "suspended";
    held(0).refuses = true;
    looks(out, 1.5);
    expect(made).toHaveLength(2);
  });

  it("waits for a person's click where it never ran", () => {
    const out = output();
    held(0).state = "suspended";
    held(0).refuses = true;
    looks(out, 20);
    expect(made).toHaveLength(1);
    expect(held(0).resumed).toBe(0);
  });

  it("does not take a sleep for a stall", () => {
    const out = output();
    looks(out, 1);
    held(0).stuck = true;
    looks(out, 0.3);
    now += 30;
    out.look();
    held(0).stuck = false;
    looks(out, 2);
    expect(made).toHaveLength(1);
  });

  it("knows what is heard, at another time too, and later by the trim", () => {
    const out = output();
    now += 2;
    expect(out.heard()).toBeCloseTo(1.98, 9);
    expect(out.heard(now + 0.5)).toBeCloseTo(2.48, 9);
    out.trim = 0.2;
    expect(out.heard()).toBeCloseTo(1.78, 9);
  });
});
