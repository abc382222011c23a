import { beforeAll, afterEach, describe, expect, it } from "vitest";
import { clockTime, percent, valveNames } from "../state/readout";
import { film } from "./film/en";
import { list, number } from "./format";
import { languageStore, type Language } from "./language";
import { keyName, noteName } from "./note-names";
import { piece } from "./piece/en";
import { serverWords } from "./server-words";
import { loadMessages } from "./words";

beforeAll(async () => {
  await Promise.all([loadMessages("de"), loadMessages("ja")]);
});
afterEach(() => languageStore.set("en"));

function said<T>(say: () => T): Record<Language, T> {
  const each = (["en", "de", "ja"] as const).map((code) => {
    languageStore.set(code);
    return [code, say()] as const;
  });
  return Object.fromEntries(each) as Record<Language, T>;
}

describe("words", () => {
  it("are those of the language that is shown, at once", () => {
    expect(said(() => film.cancel)).toEqual({ en: "Cancel", de: "Abbrechen", ja: "中止" });
  });

  it("hold what they are told, with numbers as the language writes them", () => {
    expect(said(() => film.frame({ done: 1024, of: 21600 }))).toEqual({
      en: "Frame 1,024 of 21,600",
      de: "Bild 1.024 von 21.600",
      ja: "21,600フレーム中1,024フレーム",
    });
  });

  it("count as the language does", () => {
    expect(said(() => [piece.notes({ count: 1 }), piece.notes({ count: 2 })])).toEqual({
      en: ["1 note", "2 notes"],
      de: ["1 Note", "2 Noten"],
      ja: ["1音", "2音"],
    });
  });

  it("are the server's own where the page has none", () => {
    expect(said(() => serverWords("instrument", "trumpet", "B♭ trumpet")).de).toBe("B-Trompete");
    expect(said(() => serverWords("seat", "far left", "Far left")).ja).toBe("左端");
    expect(said(() => serverWords("problem", "urn:reina:problem:stale-write", "Stale")).de).toContain("Show");
    expect(said(() => serverWords("instrument", "zugtrompete", "slide trumpet")).de).toBe("slide trumpet");
  });
});

describe("figures", () => {
  it("are written as the language does", () => {
    expect(said(() => number(1234.5))).toEqual({ en: "1,234.5", de: "1.234,5", ja: "1,234.5" });
    expect(said(() => clockTime(62.53, true))).toEqual({ en: "1:02.5", de: "1:02,5", ja: "1:02.5" });
    expect(said(() => percent(0.75))).toEqual({ en: "75 %", de: "75 %", ja: "75%" });
    expect(said(() => list(["a", "b", "c"]))).toEqual({ en: "a, b and c", de: "a, b und c", ja: "a、b、c" });
    expect(said(() => valveNames([1, 3]))).toEqual({ en: "1 and 3", de: "1 und 3", ja: "1、3" });
  });
});

describe("note names", () => {
  it.each([
    ["C4", "c′", "ド4"],
    ["B4", "h′", "シ4"],
    ["B♭4", "b′", "シ♭4"],
    ["F♯3", "fis", "ファ♯3"],
    ["E♭5", "es″", "ミ♭5"],
    ["A♭5", "as″", "ラ♭5"],
    ["C♭5", "ces″", "ド♭5"],
    ["E♯4", "eis′", "ミ♯4"],
    ["B♭2", "B", "シ♭2"],
    ["B♭1", "B₁", "シ♭1"],
    ["B♯4", "his′", "シ♯4"],
    ["×", "×", "×"],
  ])("%s is %s in German and %s in Japanese", (name, de, ja) => {
    expect(said(() => noteName(name))).toEqual({ en: name, de, ja });
  });

  it.each([
    ["B♭ major", "B-Dur", "変ロ長調"],
    ["B minor", "h-Moll", "ロ短調"],
    ["E♭ major", "Es-Dur", "変ホ長調"],
    ["F♯ minor", "fis-Moll", "嬰ヘ短調"],
    ["C major", "C-Dur", "ハ長調"],
    ["no key", "no key", "no key"],
  ])("%s is %s in German and %s in Japanese", (name, de, ja) => {
    expect(said(() => keyName(name))).toEqual({ en: name, de, ja });
  });
});
