import { describe, expect, it } from "vitest";
import { remember, remembered } from "./storage";

function storageOf(content: Record<string, string> = {}) {
  return {
    getItem: (key: string) => content[key] ?? null,
    setItem: (key: string, value: string) => {
      content[key] = value;
    },
  };
}

describe("what the browser remembers", () => {
  it("is merged change by change", () => {
    const storage = storageOf();
    remember({ volume: 0.4 }, storage);
    remember({ tokens: { a: "t" } }, storage);
    expect(remembered(storage)).toMatchObject({ volume: 0.4, tokens: { a: "t" }, muted: false });
  });

  it("falls back to defaults when it cannot be read or written", () => {
    expect(remembered(storageOf({ reina: "{" })).volume).toBe(0.9);
    expect(remembered(null).home).toBeNull();
    const full = {
      getItem: () => null,
      setItem: () => {
        throw new Error("full");
      },
    };
    expect(() => remember({ muted: true }, full)).not.toThrow();
  });

  it("does not grow without end", () => {
    const storage = storageOf();
    const tokens = Object.fromEntries(Array.from({ length: 500 }, (_, i) => [`s${i}`, "t"]));
    remember({ tokens }, storage);
    expect(Object.keys(remembered(storage).tokens)).toHaveLength(200);
    expect(remembered(storage).tokens["s499"]).toBe("t");
  });
});
