import { describe, expect, it } from "vitest";
import { literalTexts } from "./literal-text";

const SOURCES = import.meta.glob<string>(["../**/*.{ts,svelte}", "!../**/*.test.ts", "!../{generated,gallery}/**"], {
  query: "?raw",
  import: "default",
  eager: true,
});

/** Whose words are for programs and those who write them, or are engraved the same in every language. */
const NOT_FOR_THE_PAGE = new Set([
  "../film/commissioned-film.ts",
  "../paper/drum-hands.ts",
  "../paper/drum-notes.ts",
  "../paper/engrave.ts",
  "../paper/lettering.ts",
  "../rig/merge-meshes.ts",
  "../rig/skeleton-check.ts",
  "../state/measures.ts",
]);

/** What looks like words and is none: names of the protocol and of three.js. */
const NO_WORDS = new Set([
  // A file's name.
  "… film",
  "Bearer …",
  "part …",
  "drawn …",
  "drawn metal",
  "contact shade",
  "centroid varying",
  // Cursors, files, and a class beside another; a key of a list; an error in matrices.
  "… loop",
  "… show.json",
  "tool slim",
  "field way",
  "group …",
  "RᵀR − I",
]);

const texts = Object.entries(SOURCES).flatMap(([path, source]) =>
  path.startsWith("../words/") || path.startsWith("./") || NOT_FOR_THE_PAGE.has(path)
    ? []
    : literalTexts(source, path.endsWith(".svelte"))
        .filter((text) => !NO_WORDS.has(text))
        .map((text) => ({ path, text })),
);

describe("the page's source", () => {
  it("holds no words for people: they are messages", () => {
    expect(texts.map(({ path, text }) => `${path}: ${text}`)).toEqual([]);
  });
});

describe("literalTexts", () => {
  it.each([
    ["text between tags", "<p>Let go</p>", ["Let go"]],
    ["one word", "<button>Undo</button>", ["Undo"]],
    ["a label", '<i aria-label="Close the list"></i>', ["Close the list"]],
    ["a choice in a label", `<i title="{one ? 'usual' : 'other'}: 1"></i>`, ["usual", "other", ": …"]],
    ["a choice between tags", '<p>{count === 1 ? "note" : "notes"}</p>', ["note", "notes"]],
    ["what a component is given", '<Drawer title="Film" />', ["Film"]],
  ])("finds %s", (_, source, found) => {
    expect(literalTexts(source, true).toSorted()).toEqual(found.filter((text) => /\p{L}/u.test(text)).toSorted());
  });

  it.each([
    ["a notice", 'tell("The loop begins here")', ["The loop begins here"]],
    ["a sentence with places", "say(`Reading ${name} now`)", ["Reading … now"]],
    ["a table of words", 'const WORDS = { low: "Low" }', ["Low"]],
    ["an error for people", 'throw new Error("The picture is too large")', ["The picture is too large"]],
  ])("finds %s in a module", (_, source, found) => {
    expect(literalTexts(source, false)).toEqual(found);
  });

  it.each([
    ["classes and addresses", '<a class="button main" href="/lab"></a>', true],
    ["names of every language", "<b>MIDI</b>", true],
    ["a message", "<p>{film.cancel}</p>", true],
    ["a message's key", "<p title={hint('names')}>{words[kind]}</p>", true],
    ["imports and types", 'import x from "./Some File"; type Kind = "One thing" | "Other";', false],
    ["comparisons and keys", 'if (key === "Escape") go({ "Some Key": 1 })', false],
    ["errors for who programs", 'throw new TypeError("no such place")', false],
    ["selectors and events", 'page.querySelector("main .notice"); on("ArrowLeft")', false],
  ])("leaves out %s", (_, source, isComponent) => {
    expect(literalTexts(source, isComponent)).toEqual([]);
  });
});
