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

  it("keeps its offset over a reconnection until the first new probe, which alone counts then", () => {
    const sync = new ClockSync();
    sync.add(probe(0, 0.001, 0.001));
    sync.reset();
    expect(sync.offset).toBeCloseTo(TRUE_OFFSET, 6);
    sync.add({ sentAt: 9, receivedAt: 9.2, serverTime: 12.1 });
    expect(sync.offset).toBeCloseTo(3, 6);
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
