/** What was put, one after another, to be taken back and put again. */
export class History<T> {
  readonly #same: (one: T, other: T) => boolean;
  readonly #past: readonly T[];
  readonly #future: readonly T[];
  readonly present: T;

  constructor(present: T, same: (one: T, other: T) => boolean, past: readonly T[] = [], future: readonly T[] = []) {
    this.present = present;
    this.#same = same;
    this.#past = past;
    this.#future = future;
  }

  /** What stands now, whoever put it; the same again is no step. */
  take(present: T): History<T> {
    if (this.#same(present, this.present)) return this;
    return new History(present, this.#same, [...this.#past, this.present]);
  }

  /** The last step taken back; null where there is none. */
  get undone(): History<T> | null {
    const before = this.#past.at(-1);
    if (before === undefined) return null;
    return new History(before, this.#same, this.#past.slice(0, -1), [this.present, ...this.#future]);
  }

  /** The step that was taken back last, put again; null where there is none. */
  get redone(): History<T> | null {
    const [next, ...rest] = this.#future;
    if (next === undefined) return null;
    return new History(next, this.#same, [...this.#past, this.present], rest);
  }
}
