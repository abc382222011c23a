import type { Look } from "../generated/show";
import { pageStorage } from "./storage";
import { looksWords } from "../words/editor-looks/en";

/** A look that somebody has saved in this browser. */
export interface KeptLook extends Look {
  readonly id: string;
  readonly title: string;
}

/** What a look is before it is kept. */
export type NewLook = Omit<KeptLook, "id">;

/** A file that is no file of looks; the message says what would be right. */
export class LookFileError extends Error {
  override readonly name = "LookFileError";
}

const KEY = "reina.looks";
const KIND = "looks";
const VERSION = 1;

/** The looks that are kept in this browser, in the order in which they were saved. */
export class LookLibrary {
  readonly #storage: Pick<Storage, "getItem" | "setItem"> | null;
  looks = $state.raw<readonly KeptLook[]>([]);

  constructor(storage: Pick<Storage, "getItem" | "setItem"> | null = pageStorage()) {
    this.#storage = storage;
    this.read();
  }

  /** Read them anew: another window may have changed them. */
  read(): void {
    try {
      const kept = JSON.parse(this.#storage?.getItem(KEY) ?? "[]") as unknown;
      this.looks = Array.isArray(kept) ? (kept as KeptLook[]) : [];
    } catch {
      this.looks = [];
    }
  }

  /** Keep another look; returns it. Of two that are called alike the new one gets a number. */
  save(look: NewLook): KeptLook {
    const kept = { ...look, id: crypto.randomUUID(), title: this.#free(look.title) };
    this.#keep([...this.looks, kept]);
    return kept;
  }

  rename(id: string, title: string): void {
    const others = this.looks.filter((each) => each.id !== id);
    const named = this.#free(title, others);
    this.#keep(this.looks.map((each) => (each.id === id ? { ...each, title: named } : each)));
  }

  /** Take one out; what is returned puts it back where it was. */
  remove(id: string): () => void {
    const place = this.looks.findIndex((each) => each.id === id);
    const removed = this.looks[place];
    this.#keep(this.looks.filter((each) => each.id !== id));
    return () => {
      if (removed === undefined || this.looks.some((each) => each.id === id)) return;
      this.#keep([...this.looks.slice(0, place), removed, ...this.looks.slice(place)]);
    };
  }

  /** Them all as a file's text. */
  exported(): string {
    const looks = this.looks.map(({ title, values, tracks, rest }) => ({ title, values, tracks, rest }));
    return JSON.stringify({ reina: KIND, version: VERSION, looks }, null, 2);
  }

  /**
   * Take in what `exported` wrote; returns how many there were.
   *
   * @throws LookFileError if it is something else.
   */
  import(text: string): number {
    const looks = readLooks(text);
    for (const look of looks) this.save(look);
    return looks.length;
  }

  #free(title: string, others: readonly KeptLook[] = this.looks): string {
    const taken = others.map((each) => each.title);
    const wanted = title.trim() === "" ? looksWords.look : title.trim();
    if (!taken.includes(wanted)) return wanted;
    for (let number = 2; ; number += 1) if (!taken.includes(`${wanted} ${number}`)) return `${wanted} ${number}`;
  }

  #keep(looks: readonly KeptLook[]): void {
    this.looks = looks;
    // What is full or forbidden throws, and is told.
    this.#storage?.setItem(KEY, JSON.stringify(looks));
  }
}

function readLooks(text: string): NewLook[] {
  let file: unknown;
  try {
    file = JSON.parse(text);
  } catch {
    throw new LookFileError(looksWords.notJson);
  }
  const { reina, version, looks } = Object(file) as Record<string, unknown>;
  if (reina !== KIND || !Array.isArray(looks)) {
    throw new LookFileError(looksWords.noLooks);
  }
  if (version !== VERSION) {
    throw new LookFileError(looksWords.wrongVersion({ theirs: JSON.stringify(version), ours: VERSION }));
  }
  return looks.map((look: unknown, index) => {
    const { title, values = {}, tracks = [], rest = [] } = Object(look) as Partial<NewLook>;
    if (typeof title !== "string" || typeof values !== "object" || !Array.isArray(tracks) || !Array.isArray(rest)) {
      throw new LookFileError(looksWords.incomplete({ number: index + 1 }));
    }
    return { title, values, tracks, rest };
  });
}
