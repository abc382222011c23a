import { expect, it } from "vitest";
import { groupOf, nameInGroup, rowsOf } from "./rows";

it("rows are groups by the first word, with the tracks of open ones", () => {
  const track = (parameter: string) => ({ parameter, keyframes: [] });
  const document = {
    version: 1 as const,
    title: "",
    time: "bars" as const,
    tracks: ["camera/fov", "blocks/color", "camera/roll"].map(track),
  };
  const named = rowsOf(document, new Set(["blocks"])).map((row) =>
    row.kind === "group" ? `[${row.name}]` : row.track.parameter,
  );
  expect(named).toEqual(["[camera]", "camera/fov", "camera/roll", "[blocks]"]);

  // What is sought is seen, whatever is folded up.
  const found = rowsOf(document, new Set(["blocks"]), new Set(["blocks/color"]));
  expect(found.map((row) => row.kind)).toEqual(["group", "track"]);
});

it("another player's tracks are a group of their own", () => {
  expect([groupOf("players/2/face/blink"), nameInGroup("players/2/face/blink")]).toEqual(["players 2", "face blink"]);
  expect([groupOf("lights/key/softness"), nameInGroup("lights/key/softness")]).toEqual(["lights", "key softness"]);
});
