import { describe, expect, it } from "vitest";

import { ledgerSteps, staffStep } from "./staff";

describe("staffStep", () => {
  it("puts naturals on the treble staff's lines and in its spaces", () => {
    const written = { C4: 60, D4: 62, E4: 64, F4: 65, G4: 67, B4: 71, D5: 74, F5: 77, C6: 84 };
    const steps = Object.values(written).map(staffStep);
    expect(steps).toEqual([-2, -1, 0, 1, 2, 4, 6, 8, 12]);
  });

  it("rises with every semitone", () => {
    for (let pitch = 1; pitch < 128; pitch++) expect(staffStep(pitch)).toBeGreaterThan(staffStep(pitch - 1));
  });

  it("has seven steps to the octave everywhere", () => {
    for (let pitch = 0; pitch < 116; pitch++) expect(staffStep(pitch + 12) - staffStep(pitch)).toBe(7);
  });
});

describe("ledgerSteps", () => {
  it("gives none within and next to the staff", () => {
    for (const step of [-1, 0, 4.5, 8, 9]) expect(ledgerSteps(step)).toEqual([]);
  });

  it("gives the lines from the staff out to the note", () => {
    expect(ledgerSteps(-2)).toEqual([-2]);
    expect(ledgerSteps(-5)).toEqual([-2, -4]);
    expect(ledgerSteps(-6)).toEqual([-2, -4, -6]);
    expect(ledgerSteps(13)).toEqual([10, 12]);
  });

  it("holds a sharp on its natural's ledger line", () => {
    expect(ledgerSteps(staffStep(61))).toEqual([-2]);
  });
});
