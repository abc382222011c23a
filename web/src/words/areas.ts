import type { Translated } from "./words";

/** Messages by area, from the files that hold them: `./film/de.json` has those of `film`. */
export function areasOf(files: Readonly<Record<string, unknown>>): Translated {
  return Object.fromEntries(
    Object.entries(files).map(([path, messages]) => [path.split("/")[1], messages]),
  ) as Translated;
}
