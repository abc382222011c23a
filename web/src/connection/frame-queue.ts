import { FrameReader, HEADER_SIZE, type Frame, type Manifest } from "../generated/protocol";
import { FrameBlend } from "./frame-blend";

const EPOCHS = 256;

/** Frames further apart than this were lost in between, and are not blended over. */
const MAX_FRAMES_BLENDED_OVER = 8;

/** Due times of one frame may differ by a rounding where it is sent twice, seconds. */
const SAME_S = 1e-4;

/** What is to be drawn at a moment: a frame, or the blend of two. The same object is given out each time. */
export interface QueuedFrame {
  songTime: number;
  index: number;
  epoch: number;
  playing: boolean;
  /** How many frames that are cuts were come to so far. */
  cuts: number;
  /** Behind the header: joint quaternions, root positions, parameters, at the manifest's offsets less 24 bytes. */
  readonly floats: Float32Array;
}

interface Slot {
  readonly frame: Frame;
  /** The frame's floats behind its header. */
  readonly floats: Float32Array;
}

/**
 * The frames that have come and are not yet past, in a ring of fixed size: nothing is allocated for a frame.
 *
 * Frames may come ahead of their time; `frameAt` picks those around a moment of the server's clock. A frame of a newer
 * epoch drops all older ones, a frame of an older epoch is dropped itself.
 */
export class FrameQueue {
  readonly #reader: FrameReader;
  readonly #blend: FrameBlend;
  readonly #slots: Slot[];
  readonly #drawn: QueuedFrame;
  #first = 0;
  #count = 0;
  #epoch: number;
  #firstDue = Infinity;
  #shown = false;

  /**
   * @param manifest what `hello` says
   * @param epoch the transport's epoch in `hello`; older frames than that are dropped
   * @param capacity how many frames are kept; when more come, the oldest go
   */
  constructor(manifest: Manifest, epoch: number, capacity = 240) {
    const reader = new FrameReader(manifest);
    this.#reader = reader;
    this.#blend = new FrameBlend(manifest);
    this.#slots = Array.from({ length: capacity }, () => {
      const frame = reader.createFrame();
      return { frame, floats: new Float32Array(frame.words.buffer, HEADER_SIZE) };
    });
    this.#epoch = epoch % EPOCHS;
    const floats = new Float32Array(this.#blend.length);
    this.#drawn = { songTime: 0, index: 0, epoch: this.#epoch, playing: false, cuts: 0, floats };
  }

  /** How many frames are held. */
  get length(): number {
    return this.#count;
  }

  /** What `frameAt` gave last; null before the first frame. */
  get drawn(): QueuedFrame | null {
    return this.#shown ? this.#drawn : null;
  }

  /** The epoch of the frames held, modulo 256. */
  get epoch(): number {
    return this.#epoch;
  }

  /** Server time at which the last frame held is due, seconds; -Infinity with none. */
  get lastDue(): number {
    return this.#count === 0 ? -Infinity : this.#slot(this.#count - 1).frame.dueTimeS;
  }

  /** Server time at which the first frame of the last message is due, seconds; Infinity where none of it was kept. */
  get firstDue(): number {
    return this.#firstDue;
  }

  /**
   * Take in a binary message: one or more whole frames, back to back. Returns how many were kept; those that were
   * here already are not.
   *
   * @throws RangeError when it is not whole frames of this manifest and version
   */
  push(message: ArrayBuffer): number {
    const count = this.#reader.open(message);
    let kept = 0;
    this.#firstDue = Infinity;
    for (let number = 0; number < count; number++) {
      if (this.#count === this.#slots.length) this.#dropFirst();
      const { frame } = this.#slot(this.#count);
      this.#reader.read(number, frame);
      const ahead = epochsAhead(frame.epoch, this.#epoch);
      if (ahead < 0) continue;
      if (ahead > 0) this.#restart(frame.epoch);
      else if (this.#cameBefore(frame)) continue;
      if (kept === 0) this.#firstDue = frame.dueTimeS;
      this.#count += 1;
      kept += 1;
    }
    return kept;
  }

  /**
   * The picture at a moment of the server's clock, seconds: the frame due then, or the blend of the two around it.
   *
   * Before the first frame's time it is that frame, after the last one's that one (a stream that stalls holds still).
   * Null until the first frame has come. Frames that are past are let go.
   */
  frameAt(serverTime: number): QueuedFrame | null {
    while (this.#count > 1 && this.#slot(1).frame.dueTimeS <= serverTime) this.#dropFirst();
    if (this.#count === 0) return this.#shown ? this.#drawn : null;
    const a = this.#slot(0);
    const b = this.#slot(this.#count > 1 ? 1 : 0);
    const u = fractionBetween(a.frame, b.frame, serverTime);
    this.#blend.blend(a.floats, b.floats, u, this.#drawn.floats);
    this.#drawn.songTime = a.frame.songTimeS + (b.frame.songTimeS - a.frame.songTimeS) * u;
    this.#drawn.index = a.frame.index;
    this.#drawn.epoch = a.frame.epoch;
    this.#drawn.playing = a.frame.playing;
    this.#shown = true;
    return this.#drawn;
  }

  /** Let go of every frame of an older epoch than this one, as a `transport` message announces it. */
  enterEpoch(epoch: number): void {
    if (epochsAhead(epoch % EPOCHS, this.#epoch) > 0) {
      this.#epoch = epoch % EPOCHS;
      this.#count = 0;
    }
  }

  /** Whether a frame of this epoch is no later than the last that is held; the end of the music is a frame anew. */
  #cameBefore(frame: Frame): boolean {
    if (this.#count === 0) return false;
    const last = this.#slot(this.#count - 1).frame;
    if (frame.playing !== last.playing) return false;
    return (
      frame.dueTimeS < last.dueTimeS - SAME_S || (frame.index === last.index && frame.dueTimeS < last.dueTimeS + SAME_S)
    );
  }

  /** Keep only the frame that was just read, the first of a newer epoch. */
  #restart(epoch: number): void {
    this.#epoch = epoch;
    this.#first = (this.#first + this.#count) % this.#slots.length;
    this.#count = 0;
  }

  #dropFirst(): void {
    this.#first = (this.#first + 1) % this.#slots.length;
    this.#count -= 1;
    if (this.#count > 0 && this.#slot(0).frame.cut) this.#drawn.cuts += 1;
  }

  #slot(place: number): Slot {
    const slot = this.#slots[(this.#first + place) % this.#slots.length];
    if (slot === undefined) throw new RangeError("a frame queue needs a capacity of at least one frame");
    return slot;
  }
}

/** How many epochs `epoch` is ahead of `reference`, both modulo 256: negative when it is older. */
export function epochsAhead(epoch: number, reference: number): number {
  const ahead = (epoch - reference + EPOCHS) % EPOCHS;
  return ahead < EPOCHS / 2 ? ahead : ahead - EPOCHS;
}

/** How far from `a` to `b` a moment is, 0…1; 0 where the two must not be blended. */
function fractionBetween(a: Frame, b: Frame, serverTime: number): number {
  const apart = b.index - a.index;
  if (apart <= 0 || apart > MAX_FRAMES_BLENDED_OVER || b.cut || b.first) return 0;
  const span = b.dueTimeS - a.dueTimeS;
  return span > 0 ? Math.min(Math.max((serverTime - a.dueTimeS) / span, 0), 1) : 0;
}
