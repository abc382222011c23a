import { describe, expect, it } from "vitest";
import { literalTexts } from "./literal-text";

const sources = import.meta.glob(["../**/*.{ts,svelte}", "!../**/*.test.ts", "!../generated/**", "!./**"], {
  query: "?raw",
  import: "default",
  eager: true,
}) as Record<string, string>;

describe("x", () => {
  it("prints", () => {
    const fs = Object.entries(sources)
      .map(([f, s]) => [f, literalTexts(s, f.endsWith(".svelte"))] as const)
      .filter(([, t]) => t.length > 0);
    for (const [f, t] of fs) console.log(f + "\n   " + t.join("\n   "));
    expect(1).toBe(1);
  });
});
