import { describe, expect, it } from "vitest";
import { LookFileError, LookLibrary } from "./looks.svelte";

function storage() {
  const content: Record<string, string> = {};
  return {
    getItem: (key: string) => content[key] ?? null,
    setItem: (key: string, value: string) => {
      content[key] = value;
    },
  };
}
const look = (title: string) => ({ title, values: { "lights/haze": 1 }, rest: ["lights"] });
const titles = (library: LookLibrary) => library.looks.map(({ title }) => title);

describe("the library of looks", () => {
  it("is kept by the browser, and each look has its own name", () => {
    const place = storage();
    const library = new LookLibrary(place);
    library.save(look("Blue"));
    const second = library.save(look("Blue "));
    expect(titles(new LookLibrary(place))).toEqual(["Blue", "Blue 2"]);
    library.rename(second.id, "Red");
    library.rename(second.id, "Red");
    library.save(look(" "));
    expect(titles(new LookLibrary(place))).toEqual(["Blue", "Red", "Look"]);
  });

  it("gives a look back that was removed, where it was", () => {
    const library = new LookLibrary(storage());
    const kept = ["A", "B", "C"].map((title) => library.save(look(title)));
    const undo = library.remove(kept[1]?.id ?? "");
    expect(titles(library)).toEqual(["A", "C"]);
    undo();
    undo();
    expect(titles(library)).toEqual(["A", "B", "C"]);
  });

  it("goes to another browser by its file", () => {
    const library = new LookLibrary(storage());
    library.save(look("Blue"));
    const other = new LookLibrary(storage());
    expect(other.import(library.exported())).toBe(1);
    expect(other.import(library.exported())).toBe(1);
    expect(titles(other)).toEqual(["Blue", "Blue 2"]);
    expect(other.looks[0]).toMatchObject({ values: { "lights/haze": 1 }, rest: ["lights"] });
  });

  it.each([
    ["{", "This is not JSON."],
    ['{"version": 1, "tracks": []}', "This is no file of looks. A show is opened"],
    ['{"reina": "looks", "version": 2, "looks": []}', "version 2; version 1 is read here"],
    ['{"reina": "looks", "version": 1, "looks": [{"values": {}}]}', "Look 1 of the file has no title"],
  ])("refuses %s, and nothing of it is taken", (text, message) => {
    const library = new LookLibrary(storage());
    expect(() => library.import(text)).toThrow(LookFileError);
    expect(() => library.import(text)).toThrow(message);
    expect(library.looks).toEqual([]);
  });

  it("works without a storage, and with one that was written by something else", () => {
    const library = new LookLibrary(null);
    library.save(look("Blue"));
    expect(titles(library)).toEqual(["Blue"]);
    expect(new LookLibrary({ getItem: () => "{", setItem: () => undefined }).looks).toEqual([]);
  });
});
