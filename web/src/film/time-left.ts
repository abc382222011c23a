/** How long a piece of work still takes, by how it went lately. */

import { film } from "../words/film/en";

/** What went before this is of another pace, seconds. */
const WINDOW_S = 8;
/** A shorter look says nothing, seconds. */
const SHORTEST_LOOK_S = 1;

interface Mark {
  readonly at: number;
  readonly done: number;
}

export class TimeLeft {
  readonly #total: number;
  #marks: Mark[] = [];

  /** @param total how much there is to do. */
  constructor(total: number) {
    this.#total = total;
  }

  /**
   * Note how much is done at a time.
   *
   * @param at seconds on any clock that runs evenly.
   * @returns seconds that are left, or null while that cannot be said.
   */
  mark(done: number, at: number): number | null {
    this.#marks.push({ at, done });
    // One of those before the window stays, so that slow work has two.
    while ((this.#marks[1]?.at ?? at) < at - WINDOW_S) this.#marks.shift();
    const first = this.#marks[0];
    if (first === undefined || at - first.at < SHORTEST_LOOK_S || done <= first.done) return null;
    return ((this.#total - done) * (at - first.at)) / (done - first.done);
  }
}

/** A length of time as one says it: `about 3 min`. */
export function lengthOfTime(seconds: number): string {
  if (seconds < 50) return film.aboutSeconds({ count: Math.max(5, 5 * Math.ceil(seconds / 5)) });
  const minutes = Math.ceil(seconds / 60);
  if (minutes < 60) return film.aboutMinutes({ count: minutes });
  const tens = Math.ceil(minutes / 10);
  return film.aboutHours({ hours: Math.floor(tens / 6), minutes: (tens % 6) * 10 });
}
