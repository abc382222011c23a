import { describe, expect, it } from "vitest";
import type { FileRole } from "../generated/protocol";
import { namesOf, sortFiles } from "./dropped-files";

const files = ["Reverie.MID", "take 3.wav", "lights.json", "cover.png", "tune.json"].map(
  (name) => new File(["x"], name),
);
const roles: Record<string, FileRole["role"]> = {
  "Reverie.MID": "score",
  "take 3.wav": "song",
  "lights.json": "show",
  "tune.json": "score",
};

describe("sortFiles", () => {
  it("puts each file where the server says it belongs, in the order in which they came", async () => {
    const ask = (file: File): Promise<FileRole> =>
      Promise.resolve({ role: roles[file.name] ?? null, name: "something", advice: "" });
    const { scores, songs, shows, unusable } = await sortFiles(files, ask);
    expect(
      [scores, songs, shows, unusable.map(({ file }) => file)].map((each) => each.map(({ name }) => name)),
    ).toEqual([["Reverie.MID", "tune.json"], ["take 3.wav"], ["lights.json"], ["cover.png"]]);
  });
});

describe("namesOf", () => {
  it("names files as one says them", () => {
    expect(namesOf(files.slice(0, 1))).toBe("Reverie.MID");
    expect(namesOf(files.slice(0, 3))).toBe("Reverie.MID, take 3.wav and lights.json");
  });
});
