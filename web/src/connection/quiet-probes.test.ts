import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { ClockSync, type ClockProbe } from "./clock-sync";
import { QuietProbes } from "./quiet-probes";

let asked: number;

function probing(roundTrip: number, answer: () => Promise<ClockProbe>): [ClockSync, QuietProbes] {
  const clock = new ClockSync();
  clock.add({ sentAt: 0, receivedAt: roundTrip, serverTime: roundTrip });
  const probes = new QuietProbes(clock, () => {
    asked += 1;
    return answer();
  });
  probes.begin();
  return [clock, probes];
}

const answered = (): Promise<ClockProbe> => Promise.resolve({ sentAt: 1, receivedAt: 1.3, serverTime: 1.15 });

beforeEach(() => {
  vi.useFakeTimers();
  asked = 0;
});
afterEach(() => {
  vi.useRealTimers();
});

describe("QuietProbes", () => {
  it("asks nothing where the stream's own probes are exact", async () => {
    probing(0.002, answered);
    await vi.advanceTimersByTimeAsync(60_000);
    expect(asked).toBe(0);
  });

  it("asks often at first and seldom then, and betters the clock", async () => {
    const [clock, probes] = probing(0.4, answered);
    expect(clock.offset).toBeCloseTo(0.2, 6);
    await vi.advanceTimersByTimeAsync(3050);
    expect(asked).toBe(60);
    expect(clock.offset).toBeCloseTo(0, 6);
    await vi.advanceTimersByTimeAsync(30_000);
    expect(asked).toBeGreaterThan(88);
    expect(asked).toBeLessThan(92);
    const before = asked;
    probes.begin();
    await vi.advanceTimersByTimeAsync(1050);
    expect(asked, "many again after a sleep").toBe(before + 20);
    probes.close();
    await vi.advanceTimersByTimeAsync(30_000);
    expect(asked).toBe(before + 20);
  });

  it("goes on asking a server that does not answer", async () => {
    probing(0.4, () => Promise.reject(new Error("away")));
    await vi.advanceTimersByTimeAsync(3000);
    expect(asked).toBeGreaterThan(5);
  });
});
