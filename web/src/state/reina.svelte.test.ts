import { describe, expect, it } from "vitest";
import { ReinaApi } from "../connection";
import { Reina } from "./reina.svelte";

/** Something that goes on until it is told to end. */
function until(): { readonly over: Promise<void>; end(): void } {
  let end = (): void => undefined;
  const over = new Promise<void>((resolve) => (end = resolve));
  return { over, end: () => end() };
}

describe("Reina", () => {
  it("is busy with what still goes on, whichever of two things ends first", async () => {
    const reina = new Reina(new ReinaApi());
    const [opening, reading] = [until(), until()];
    const first = reina.attempt("opening", () => opening.over);
    const second = reina.attempt("reading", () => reading.over);
    expect(reina.busy).toBe("reading");
    opening.end();
    await first;
    expect(reina.busy).toBe("reading");
    reading.end();
    await second;
    expect(reina.busy).toBeNull();
  });
});
