import type { Manifest, TransportState } from "../generated/protocol";
import { FrameBlend } from "./frame-blend";
import { BLOCK_FRAMES, blockOf, isCut, type Block } from "./packed-block";
import { frameOf, loopAhead, songTimeAt } from "./song-time";

/** The server leaves out what it sent within the last 12 blocks; some more are here of what comes next. */
const KEPT = 32;

/** What is to be drawn at a moment: a frame, or the blend of two. The same object is given out each time. */
export interface PlayedFrame {
  songTime: number;
  /** A blend counts as the earlier of its two. */
  index: number;
  /** The transport's epoch; that of the last picture before an edit, where the picture is of before it. */
  epoch: number;
  /** Which state of score, cast and show it is of. */
  revision: string;
  playing: boolean;
  /** How often a frame that is a cut was come to so far, or gone to from elsewhere. */
  cuts: number;
  /** Behind the header: joint quaternions, root positions, parameters, at the manifest's offsets less 24 bytes. */
  readonly floats: Float32Array;
}

interface Kept {
  readonly block: Block;
  /** The greater, the later it came or was drawn. */
  used: number;
}

/**
 * The blocks that have come, and the picture that they give at any moment: nothing is allocated for a frame.
 *
 * After an edit the blocks of before it are drawn until the present one has come anew.
 */
export class BlockPlayer {
  readonly #blend: FrameBlend;
  readonly #fps: number;
  readonly #drawn: PlayedFrame;
  #blocks = new Map<number, Kept>();
  #before: Map<number, Kept> | null = null;
  #revision: string;
  #uses = 0;
  #shown = false;

  /** @param revision which state of score, cast and show the blocks have to be of */
  constructor(manifest: Manifest, revision: string) {
    this.#blend = new FrameBlend(manifest);
    this.#fps = manifest.fps;
    this.#revision = revision;
    const floats = new Float32Array(this.#blend.length);
    this.#drawn = { songTime: 0, index: 0, epoch: -1, revision: "", playing: false, cuts: 0, floats };
  }

  /** What `frameAt` gave last; null before the first. */
  get drawn(): PlayedFrame | null {
    return this.#shown ? this.#drawn : null;
  }

  get revision(): string {
    return this.#revision;
  }

  /** There was an edit: blocks of another revision count from now on. */
  follow(revision: string): void {
    if (revision === this.#revision) return;
    this.#revision = revision;
    this.#before ??= this.#blocks;
    this.#blocks = new Map();
  }

  /** Take a block in; one of another revision is dropped. When there are too many, the one goes that was used least lately. */
  add(block: Block): void {
    if (block.revision !== this.#revision) return;
    this.#blocks.set(block.number, { block, used: ++this.#uses });
    if (this.#blocks.size <= KEPT) return;
    const [[oldest] = [block.number]] = [...this.#blocks].sort(([, a], [, b]) => a.used - b.used);
    this.#blocks.delete(oldest);
  }

  /** Whether a block of the present revision is here. */
  has(number: number): boolean {
    return this.#blocks.has(number);
  }

  /**
   * The picture at a moment of the server's clock, seconds: while playing the blend of the two frames around it.
   *
   * Where its block is not here the last one stands; null until there was one.
   *
   * @param duration where the song ends, seconds
   */
  frameAt(transport: TransportState, serverTime: number, duration: number): PlayedFrame | null {
    const songTime = songTimeAt(transport, serverTime, duration);
    const last = this.#lastOf(transport, duration);
    const index = Math.min(frameOf(songTime, this.#fps), last);
    const present = this.#blocks.get(blockOf(index));
    if (present !== undefined) this.#before = null;
    const kept = present ?? this.#before?.get(blockOf(index));
    const frame = kept?.block.frames[index % BLOCK_FRAMES];
    if (kept === undefined || frame === undefined) return this.drawn;
    const next = index < last ? this.#blendable(index + 1) : undefined;
    const u = next === undefined ? 0 : Math.max(songTime * this.#fps - index, 0);
    const drawn = this.#drawn;
    this.#blend.blend(frame, next ?? frame, u, drawn.floats);
    if (this.#cutBetween(drawn.index, index)) drawn.cuts += 1;
    drawn.songTime = (index + u) / this.#fps;
    drawn.index = index;
    drawn.playing = transport.playing && (loopAhead(transport) !== null || songTime < duration);
    drawn.revision = kept.block.revision;
    if (present !== undefined) drawn.epoch = transport.epoch;
    kept.used = ++this.#uses;
    this.#shown = true;
    return drawn;
  }

  /** The last frame that is come to: the present one while paused, else before a loop's end, or the song's. */
  #lastOf(transport: TransportState, duration: number): number {
    const loop = loopAhead(transport);
    if (!transport.playing) return frameOf(transport.song_time_s, this.#fps);
    return loop === null ? frameOf(duration, this.#fps) : -frameOf(-loop.end_s, this.#fps) - 1;
  }

  /** A frame that the one before may be blended into; undefined where it is not here, or a cut. */
  #blendable(index: number): Float32Array | undefined {
    const block = this.#at(index);
    return block === undefined || isCut(block, index % BLOCK_FRAMES) ? undefined : block.frames[index % BLOCK_FRAMES];
  }

  /** Whether the way from one frame to another goes over a cut, or over so much that it is one. */
  #cutBetween(from: number, to: number): boolean {
    if (to < from || to > from + BLOCK_FRAMES) return true;
    for (let index = from + 1; index <= to; index++) {
      const block = this.#at(index);
      if (block !== undefined && isCut(block, index % BLOCK_FRAMES)) return true;
    }
    return false;
  }

  /** The block that a frame is drawn from. */
  #at(index: number): Block | undefined {
    return (this.#before ?? this.#blocks).get(blockOf(index))?.block;
  }
}
