import type { ShowDocument, ShowKeyframe, ShowTrack } from "./show-document";

/** A keyframe with the track that it stands on. */
export interface ChosenKey {
  readonly track: ShowTrack;
  readonly keyframe: ShowKeyframe;
}

/** What is chosen, which is one thing: keyframes, by track, or a marker, or a track as a whole. */
export class Selection {
  #byTrack = $state.raw<ReadonlyMap<string, ReadonlySet<string>>>(new Map());
  #marker = $state<number | null>(null);
  #track = $state<string | null>(null);

  /** How many are chosen. */
  readonly size: number = $derived.by(() => {
    let size = 0;
    for (const keys of this.#byTrack.values()) size += keys.size;
    return size;
  });

  /** The chosen keys of each track; to be read, for drawing. */
  get byTrack(): ReadonlyMap<string, ReadonlySet<string>> {
    return this.#byTrack;
  }

  /** Index of the chosen marker. */
  get marker(): number | null {
    return this.#marker;
  }

  /** Choose a marker and nothing else; null leaves keyframes as they are. */
  set marker(index: number | null) {
    if (index !== null) this.clear();
    this.#marker = index;
  }

  /** Path of the track that is chosen as a whole. */
  get track(): string | null {
    return this.#track;
  }

  /** Choose a track, and none of its keyframes nor anything else. */
  chooseTrack(path: string): void {
    this.clear();
    this.#track = path;
  }

  has(path: string, key: string): boolean {
    return this.#byTrack.get(path)?.has(key) === true;
  }

  clear(): void {
    this.#byTrack = new Map();
    this.#marker = this.#track = null;
  }

  /** Choose these and nothing else. */
  set(keys: Iterable<readonly [path: string, key: string]>): void {
    const byTrack = new Map<string, Set<string>>();
    for (const [path, key] of keys) {
      const ofTrack = byTrack.get(path);
      if (ofTrack === undefined) byTrack.set(path, new Set([key]));
      else ofTrack.add(key);
    }
    this.#byTrack = byTrack;
    this.#marker = this.#track = null;
  }

  /** Choose these beside what is chosen. */
  add(keys: Iterable<readonly [path: string, key: string]>): void {
    this.set([...this.#entries(), ...keys]);
  }

  /** Choose these, or leave them out where all of them were chosen. */
  toggle(keys: readonly (readonly [path: string, key: string])[]): void {
    if (!keys.every(([path, key]) => this.has(path, key))) {
      this.add(keys);
      return;
    }
    const out = new Set(keys.map(([path, key]) => `${path}\n${key}`));
    this.set([...this.#entries()].filter(([path, key]) => !out.has(`${path}\n${key}`)));
  }

  /** The chosen keyframes as they stand in a show, by track and time; what is gone is left out. */
  keysOf(document: ShowDocument | null): ChosenKey[] {
    return keysOf(document, this.#byTrack);
  }

  *#entries(): Generator<readonly [string, string]> {
    for (const [path, keys] of this.#byTrack) for (const key of keys) yield [path, key];
  }
}

/** Keyframes as they stand in a show, by track and time; what is gone is left out. */
export function keysOf(document: ShowDocument | null, byTrack: ReadonlyMap<string, ReadonlySet<string>>): ChosenKey[] {
  if (document === null || byTrack.size === 0) return [];
  return document.tracks.flatMap((track) => {
    const keys = byTrack.get(track.parameter);
    if (keys === undefined) return [];
    return track.keyframes.filter(({ key }) => keys.has(key)).map((keyframe) => ({ track, keyframe }));
  });
}

/** Chosen keyframes by their tracks, each track's in their order. */
export function byTrack(keys: readonly ChosenKey[]): Map<ShowTrack, ShowKeyframe[]> {
  const found = new Map<ShowTrack, ShowKeyframe[]>();
  for (const { track, keyframe } of keys) {
    const chosen = found.get(track);
    if (chosen === undefined) found.set(track, [keyframe]);
    else chosen.push(keyframe);
  }
  return found;
}
