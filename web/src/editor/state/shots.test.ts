import { describe, expect, it } from "vitest";
import type { ShowTrack } from "./show-document";
import { cutSideOf, keysInShot, shotsOf, withCuts } from "./shots";

const key = (name: string, time: number, interpolation = "step") => ({ key: name, time, value: 0, interpolation });
const POSITION: ShowTrack = {
  parameter: "camera/position",
  keyframes: [key("p1", 0), key("p2", 3.96, "sine_in_out"), key("p3", 4), key("p4", 8)],
};
const FOV: ShowTrack = { parameter: "camera/fov", keyframes: [key("f1", 0), key("f2", 4), key("f3", 6)] };
const LIGHT: ShowTrack = {
  parameter: "lights/key/intensity",
  keyframes: [key("l1", 1, "linear"), key("l2", 4), key("l3", 5, "linear"), key("l4", 5.1)],
};
const TRACKS = [POSITION, FOV, LIGHT];
const timesOf = ({ keyframes }: ShowTrack) => Float64Array.from(keyframes, ({ time }) => time);
const carried = (path: string, name: string) =>
  [...withCuts(TRACKS, timesOf, new Map([[path, new Set([name])]]))].flatMap(([, keys]) => [...keys]).sort();

describe("cuts", () => {
  it("are a jump and the key right before it", () => {
    const sides = POSITION.keyframes.map((_, index) => cutSideOf(POSITION, timesOf(POSITION), index));
    expect(sides).toEqual([null, "end", "begin", null]);
  });

  it("move as one, whichever side is taken, with what the camera does there", () => {
    expect(carried("camera/position", "p3")).toEqual(["f2", "p2", "p3"]);
    expect(carried("camera/position", "p2")).toEqual(["f2", "p2", "p3"]);
    expect(carried("lights/key/intensity", "l4")).toEqual(["l3", "l4"]);
  });

  it("leave alone what is no cut of the camera's place", () => {
    expect(carried("camera/fov", "f2")).toEqual(["f2"]);
    expect(carried("camera/position", "p4")).toEqual(["p4"]);
    expect(carried("lights/key/intensity", "l2")).toEqual(["l2"]);
  });
});

describe("shots", () => {
  it("last from cut to cut, and hold the camera's keys between", () => {
    const shots = shotsOf(TRACKS, timesOf, 12);
    expect(shots).toEqual([
      { start: 0, end: 4 },
      { start: 4, end: 8 },
      { start: 8, end: 12 },
    ]);
    expect(keysInShot(TRACKS, timesOf, shots[1] ?? { start: 0, end: 0 }).map(([, name]) => name)).toEqual([
      "p3",
      "f2",
      "f3",
    ]);
  });

  it("are none where the camera does not cut", () => {
    expect(shotsOf([FOV, LIGHT], timesOf, 12)).toEqual([]);
  });
});
