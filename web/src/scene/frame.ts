/** The frame as the scene reads it, and where in it each value lies. */

import type { Hello } from "../generated/protocol";

/** Bytes of a frame before its first float: the header. */
export const HEADER_BYTES = 24;

/** One frame to draw. The caller reuses it; nothing here keeps a reference to it. */
export interface DrawnFrame {
  /** Seconds of the song. */
  readonly songTime: number;
  readonly index: number;
  readonly epoch: number;
  /** Which state of score, cast and show it is of. */
  readonly revision?: string;
  readonly playing: boolean;
  /** How many frames that are cuts were come to so far; the difference from picture to picture counts. */
  readonly cuts?: number;
  /** The frame from byte 24 on: joint quaternions of all skeletons, root positions, parameters. */
  readonly floats: Float32Array;
}

export type SkeletonLayout = Hello["skeletons"][number];
export type ParameterLayout = Hello["parameters"][number];

/** The hello and the rig file, or the hello and the page, do not fit. */
export class LayoutError extends Error {
  override readonly name = "LayoutError";
}

/**
 * Index into `DrawnFrame.floats` of the value at a byte offset from the frame's start.
 *
 * @throws LayoutError for an offset inside the header or between two floats.
 */
export function floatIndex(offsetBytes: number): number {
  const index = (offsetBytes - HEADER_BYTES) / 4;
  if (!Number.isInteger(index) || index < 0) {
    throw new LayoutError(
      `Offset ${offsetBytes} is not that of a float after the ${HEADER_BYTES} bytes of the header.`,
    );
  }
  return index;
}

/** Where each parameter of the frame lies, by its path. */
export class ParameterIndex {
  readonly #byPath = new Map<string, { readonly index: number; readonly length: number }>();

  constructor(parameters: readonly ParameterLayout[]) {
    for (const { path, offset, length } of parameters) {
      this.#byPath.set(path, { index: floatIndex(offset), length });
    }
  }

  /**
   * Index of a parameter's first float, or null where the session does not stream it.
   *
   * @throws LayoutError if it is streamed with another length.
   */
  find(path: string, length: number): number | null {
    const found = this.#byPath.get(path);
    if (found === undefined) return null;
    if (found.length !== length) {
      throw new LayoutError(`Parameter ${path} has ${found.length} floats; the page draws ${length}.`);
    }
    return found.index;
  }
}

/** What the paths of a cast's player begin with, the first being 0: nothing, then `players/2/`. */
export function playerPrefix(player: number): string {
  return player === 0 ? "" : `players/${player + 1}/`;
}

/** What a skeleton's own parameters begin with: nothing for the first player, `players/2/` for the second. */
export function parameterPrefix(skeletonName: string): string {
  return /^players\/\d+\//.exec(skeletonName)?.[0] ?? "";
}
