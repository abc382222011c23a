import { describe, expect, it } from "vitest";
import { ClockSync } from "./clock-sync";

const TRUE_OFFSET = 1234.5;

/** A probe whose way there and back take so long, against a server ahead by TRUE_OFFSET. */
function probe(sentAt: number, there: number, back: number) {
  return { sentAt, receivedAt: sentAt + there + back, serverTime: sentAt + there + TRUE_OFFSET };
}

describe("ClockSync", () => {
  it("takes the offset of the quickest probe, not of the last", () => {
    const sync = new ClockSync();
    sync.add(probe(0, 0.05, 0.01));
    sync.add(probe(1, 0.001, 0.001));
    sync.add(probe(2, 0.2, 0.001));
    expect(sync.offset).toBeCloseTo(TRUE_OFFSET, 6);
    expect(sync.serverTime(10)).toBeCloseTo(10 + TRUE_OFFSET, 6);
    expect(sync.roundTrip).toBeCloseTo(0.002, 9);
  });

  it("is off by at most half the round trip", () => {
    const sync = new ClockSync();
    sync.add(probe(0, 0.08, 0));
    expect(Math.abs(sync.offset - TRUE_OFFSET)).toBeLessThanOrEqual(sync.roundTrip / 2 + 1e-9);
  });

  it("forgets a quick probe once it has left the window", () => {
    const sync = new ClockSync(3);
    sync.add(probe(0, 0.001, 0.001));
    for (const at of [1, 2, 3]) sync.add(probe(at, 0.01, 0.01));
    expect(sync.roundTrip).toBeCloseTo(0.02, 9);
  });

  it("forgets all before a probe that contradicts it: a clock has jumped, or another server answers", () => {
    const sync = new ClockSync();
    for (const at of [0, 1, 2]) sync.add(probe(at, 0.001, 0.001));
    sync.add({ sentAt: 9, receivedAt: 9.2, serverTime: 12.1 });
    expect(sync.offset).toBeCloseTo(3, 6);
    expect(sync.serverTime(9.3)).toBeCloseTo(12.3, 6);
  });

  it("keeps what it knows where the same server answers more slowly", () => {
    const sync = new ClockSync();
    sync.add(probe(0, 0.001, 0.001));
    sync.add(probe(5, 0.3, 0.001));
    expect(sync.offset).toBeCloseTo(TRUE_OFFSET, 3);
  });

  it("drops absurd probes", () => {
    const sync = new ClockSync();
    expect(sync.add({ sentAt: 5, receivedAt: 4, serverTime: 0 })).toBe(false);
    expect(sync.add({ sentAt: 0, receivedAt: 30, serverTime: 0 })).toBe(false);
    expect(sync.add({ sentAt: 0, receivedAt: 0.01, serverTime: NaN })).toBe(false);
    expect(sync.ready).toBe(false);
    expect(sync.offset).toBe(0);
  });
});

/** A chain of numbers that look like chance, 0…1, the same each time. */
function chance(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state * 1664525 + 1013904223) % 2 ** 32;
    return state / 2 ** 32;
  };
}

interface Network {
  /** The way there and the way back of one probe, seconds. */
  ways(random: () => number): readonly [number, number];
  /** How much faster the server's clock runs. */
  drift?: number;
}

/** Errors of the server's time, seconds, after each probe: two a half second, as behind a slow network. */
function errorsOver(seconds: number, network: Network, seed: number): number[] {
  const random = chance(seed);
  const sync = new ClockSync();
  const errors: number[] = [];
  const serverAt = (at: number): number => TRUE_OFFSET + at * (1 + (network.drift ?? 0));
  for (let at = 0; at < seconds; at += 0.25) {
    const [there, back] = network.ways(random);
    sync.add({ sentAt: at, receivedAt: at + there + back, serverTime: serverAt(at + there) });
    errors.push(sync.serverTime(at + there + back) - serverAt(at + there + back));
  }
  return errors;
}

function jittered(random: () => number, delay = 0.15, jitter = 0.05): number {
  return delay + jitter * (2 * random() - 1);
}

/** What a lost packet adds where TCP sends it again. */
function lossy(random: () => number, share: number, wait: number): number {
  return random() < share ? wait : 0;
}

const NETWORKS: Readonly<Record<string, Network>> = {
  "150 ms, jitter 50 each way": { ways: (random) => [jittered(random), jittered(random)] },
  "and 2 % lost": {
    ways: (random) => [jittered(random) + lossy(random, 0.02, 0.5), jittered(random) + lossy(random, 0.02, 0.5)],
  },
  "and bursts of loss": {
    ways: (random) => [jittered(random) + lossy(random, 0.3, 0.9), jittered(random) + lossy(random, 0.3, 0.9)],
  },
  "jitter on the way back alone": { ways: (random) => [0.02, jittered(random, 0.12, 0.1)] },
  "2 ms, and clocks that come apart by 50 millionths": { ways: () => [0.002, 0.002], drift: 50e-6 },
  "clocks that come apart by 40 millionths": { ways: (random) => [jittered(random), jittered(random)], drift: 40e-6 },
  "and the other way": { ways: (random) => [jittered(random), jittered(random)], drift: -40e-6 },
};

describe("ClockSync behind a network", () => {
  for (const [name, network] of Object.entries(NETWORKS)) {
    it(`knows the server's clock to a few milliseconds with ${name}`, () => {
      for (let seed = 1; seed <= 20; seed++) {
        const settled = errorsOver(120, network, seed).slice(60);
        const off = settled.map((error) => Math.abs(error)).sort((a, b) => a - b);
        expect(off[Math.floor(off.length * 0.95)], `p95 with seed ${seed}`).toBeLessThan(0.006);
        expect(off.at(-1), `worst with seed ${seed}`).toBeLessThan(0.012);
      }
    });
  }

  it("is better than the quickest round trip", () => {
    let quickest = 0;
    let ours = 0;
    for (let seed = 1; seed <= 50; seed++) {
      const random = chance(seed);
      const ways = Array.from({ length: 32 }, () => [jittered(random), jittered(random)] as const);
      const sync = new ClockSync();
      for (const [place, [there, back]] of ways.entries()) sync.add(probe(place * 0.25, there, back));
      const best = ways.reduce((a, b) => (a[0] + a[1] <= b[0] + b[1] ? a : b));
      quickest += Math.abs(best[0] - best[1]) / 2;
      ours += Math.abs(sync.offset - TRUE_OFFSET);
    }
    expect(ours / quickest).toBeLessThan(0.6);
  });

  it("is off by half of what one way is always slower by, which no probe shows", () => {
    const errors = errorsOver(30, { ways: () => [0.12, 0.02] }, 1);
    expect(errors.at(-1)).toBeCloseTo(0.05, 3);
  });

  it("comes to better knowledge so slowly that nobody sees it", () => {
    const random = chance(3);
    const sync = new ClockSync();
    let before = Number.NaN;
    let steepest = 0;
    for (let at = 0; at < 60; at += 0.25) {
      sync.add(probe(at, jittered(random), jittered(random)));
      for (let later = at + 0.4; later < at + 0.6; later += 0.05) {
        const given = sync.serverTime(later) - later;
        if (at > 3 && !Number.isNaN(before)) steepest = Math.max(steepest, Math.abs(given - before));
        before = given;
      }
    }
    expect(steepest).toBeLessThan(0.004);
  });
});
