import { readFileSync } from "node:fs";
import { afterEach, beforeAll, describe, expect, it } from "vitest";
import { languageStore } from "../words/language";
import { loadMessages } from "../words/words";
import { findingText } from "./finding-text";

type Forms = string | Readonly<Record<string, string>>;
const WORDS = import.meta.glob<Record<string, Forms>>("../words/findings/*.json", { import: "default", eager: true });

/** The kinds of the server's own table, each with the places of its words. */
const TABLE = readFileSync(new URL("../../../server/reina/music/finding_words.toml", import.meta.url), "utf8");
const KINDS = new Map(
  TABLE.split(/^\["?(?=[\w/-]+"?\]$)/m)
    .slice(1)
    .map((block) => [/^[\w/-]+/.exec(block)?.[0] ?? "", placesOf(block)] as const),
);

function placesOf(text: string): ReadonlySet<string> {
  return new Set([...text.matchAll(/\{(\w+)\}/g)].map(([, name = ""]) => name));
}

beforeAll(() => Promise.all([loadMessages("de"), loadMessages("ja")]));
afterEach(() => languageStore.set("en"));

describe.each(["de", "ja"] as const)("what findings say in %s", (code) => {
  const said = WORDS[`../words/findings/${code}.json`] ?? {};

  it("has words for every kind of the server's table, and for no others", () => {
    expect(KINDS.size).toBeGreaterThan(50);
    expect(Object.keys(said)).toEqual([...KINDS.keys()]);
  });

  it("has no places that the server fills with nothing", () => {
    for (const [kind, forms] of Object.entries(said)) {
      const unknown = [...placesOf(JSON.stringify(forms))].filter((name) => KINDS.get(kind)?.has(name) !== true);
      expect(unknown, kind).toEqual([]);
    }
  });

  it("has every form that the language's numbers need", () => {
    const needed = new Intl.PluralRules(code).resolvedOptions().pluralCategories.toSorted();
    for (const [kind, forms] of Object.entries(said)) {
      if (typeof forms !== "string") expect(Object.keys(forms).toSorted(), kind).toEqual(needed);
    }
  });
});

it("is told by kind, side and count, with values and names of parts as the language has them", () => {
  const dropped = { kind: "not_playable", count: 2, values: { side: "below", instrument: "tuba" }, text: "English" };
  const heard = { kind: "parts_heard", count: 5, values: { parts: "Flute, part 2 and 3 more" }, text: "English" };
  const told = (["en", "de", "ja"] as const).map((code) => {
    languageStore.set(code);
    return [findingText(dropped), findingText(heard)];
  });
  expect(told).toEqual([
    ["English", "English"],
    ["Lässt 2 Töne unter dem Tonumfang aus", "Flute, Stimme 2, 3 weitere sind zu hören, ohne dass jemand spielt"],
    ["音域より低い2音は吹きません", "音だけが流れるパート：Flute、パート2、ほか3パート"],
  ]);
});

it("is the server's own English for a kind that an installed instrument brings", () => {
  languageStore.set("de");
  expect(findingText({ kind: "slide_too_far", count: 1, values: {}, text: "The slide is too short" })).toBe(
    "The slide is too short",
  );
});
