import { describe, expect, it } from "vitest";

import { insetSubject, offeredViews } from "./offered-views";

const TRUMPET = { valves: 3, pieces: [] };
const KIT = { valves: 0, pieces: ["snare", "kick"] };
const SLIDE = { valves: 0, pieces: [] };

describe("offeredViews", () => {
  it("has the views of who plays on valves, the third of the valves", () => {
    expect(offeredViews(TRUMPET)).toEqual(["whole_figure", "three_quarter", "valves", "face", "player", "hall"]);
    expect(offeredViews(null)).toEqual(offeredViews(TRUMPET));
  });

  it("shows the hands of who strikes with the same key, and no view twice", () => {
    const views = offeredViews(KIT);
    expect(views.slice(0, 4)).toEqual(["whole_figure", "three_quarter", "kit_overhead", "face"]);
    expect(views.slice(6)).toEqual(["kit_behind", "kit_hi_hat", "kit_feet"]);
    expect(new Set(views).size).toBe(views.length);
  });

  it("leaves a key without a view where there are neither valves nor a kit", () => {
    expect(offeredViews(SLIDE)).toEqual(["whole_figure", "three_quarter", null, "face", "player", "hall"]);
  });
});

describe("insetSubject", () => {
  it("is what is to be seen closely of the instrument", () => {
    expect([TRUMPET, KIT, SLIDE, null].map(insetSubject)).toEqual(["valves", "feet", null, "valves"]);
  });
});
