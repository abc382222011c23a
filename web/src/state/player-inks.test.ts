import { describe, expect, it } from "vitest";
import { followedInks, playerInk } from "./player-inks";

describe("followedInks", () => {
  it("keeps the colours until one is seen to be another", () => {
    const shown = ["#e8bf6e", "#5aa9f0"];
    expect(followedInks(shown, ["#e9bf70", "#5aa9f0"])).toBe(shown);
    const changed = ["#e8bf6e", "#5a89f0"];
    expect(followedInks(shown, changed)).toBe(changed);
  });

  it("takes another cast's at once", () => {
    const cast = ["#e8bf6e"];
    expect(followedInks([], cast)).toBe(cast);
    expect(followedInks(["#e8bf6e", "#5aa9f0"], cast)).toBe(cast);
  });
});

describe("playerInk", () => {
  it("has a colour for each of four before the stage has any", () => {
    expect(new Set([0, 1, 2, 3].map((player) => playerInk([], player))).size).toBe(4);
    expect(playerInk(["#000000"], 0)).toBe("#000000");
  });
});
