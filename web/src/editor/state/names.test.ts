import { readFileSync } from "node:fs";
import { afterEach, beforeAll, expect, it } from "vitest";
import { languageStore } from "../../words/language";
import { loadMessages } from "../../words/words";
import { choiceName, easingName, shownPath, typeName } from "./names";
import { findParameters } from "./find-parameters";
import { groupName } from "./rows";

/** What shows of this server may name: paths, values that are chosen among, and easings. */
const SCHEMA = readFileSync(new URL("../../../../docs/show.schema.json", import.meta.url), "utf8");
const PATHS = new Set(
  [...SCHEMA.matchAll(/"(?:const": "|\^\(players[^)]*\)?\/\)\?)([a-z_]+(?:\/[a-z_0-9]+)+)\$?"/g)].map(
    ([, path = ""]) => path,
  ),
);
const EASINGS = new Set(enums("interpolation"));
const CHOICES = new Set(
  [...SCHEMA.matchAll(/"keyframe_choice_[a-z_]+_step": \{.*?"value": \{\s*"enum": \[(.*?)\]/gs)].flatMap(
    ([, all = ""]) => [...all.matchAll(/"([a-z_]+)"/g)].map(([, name = ""]) => name),
  ),
);

function enums(field: string): string[] {
  const found = SCHEMA.matchAll(new RegExp(`"${field}": \\{[^{}]*?"enum": \\[(.*?)\\]`, "gs"));
  return [...found].flatMap(([, all = ""]) => [...all.matchAll(/"([a-z_]+)"/g)].map(([, name = ""]) => name));
}

beforeAll(() => Promise.all([loadMessages("de", "editor"), loadMessages("ja", "editor")]));
afterEach(() => languageStore.set("en"));

it.each(["de", "ja"] as const)("every path, choice and easing that a show may name has words in %s", (code) => {
  expect([PATHS.size > 60, EASINGS.size > 25, CHOICES.size > 8]).toEqual([true, true, true]);
  const english = new Map([
    ...[...PATHS].flatMap((path) => path.split("/").map((part) => [part, shownPath(part)] as const)),
    ...[...EASINGS].map((name) => [name, easingName(name)] as const),
    ...[...CHOICES].map((name) => [name, choiceName(name)] as const),
  ]);
  languageStore.set(code);
  const shown = (name: string) =>
    EASINGS.has(name) ? easingName(name) : CHOICES.has(name) ? choiceName(name) : shownPath(name);
  // A vibrato is one in German too.
  const left = [...english].filter(([name, says]) => !/^(\d+|vibrato)$/.test(name) && shown(name) === says);
  expect(left).toEqual([]);
});

it("names are the language's own, and the server's where it has none", () => {
  const said = (["en", "de", "ja"] as const).map((code) => {
    languageStore.set(code);
    return [shownPath("lights/spots/2/color"), easingName("sine_in_out"), typeName("vector"), groupName("players 2")];
  });
  expect(said).toEqual([
    ["lights spots 2 colour", "sine in out", "three numbers", "players 2"],
    ["Licht Spot 2 Farbe", "Sinus ein aus", "drei Zahlen", "Platz 2"],
    ["照明 スポット 2 色", "サイン イン アウト", "3つの数値", "奏者 2"],
  ]);
  expect(shownPath("plugin/flying_carpet")).toBe("plugin flying carpet");
});

it("parameters are found by what people call them in the language", () => {
  const parameters = ["camera/fov", "lights/haze"].map((path) => ({
    path,
    documentation: "",
    type: "number" as const,
  }));
  const found = (code: "de" | "ja", sought: string) => {
    languageStore.set(code);
    return findParameters(parameters, sought).map(({ path }) => path);
  };
  expect([found("de", "Brennweite"), found("de", "Licht Dunst"), found("ja", "ズーム")]).toEqual([
    ["camera/fov"],
    ["lights/haze"],
    ["camera/fov"],
  ]);
});
