import type { FrameBlocks, Hello, Manifest, TransportState } from "../generated/protocol";
import { BlockKeeper, type BlockWorld } from "./block-keeper";
import { BlockPlayer, type PlayedFrame } from "./block-player";
import { AHEAD_S, blocksAhead } from "./blocks-ahead";
import { blockOf, revisionOf, unpackBlock } from "./packed-block";
import { frameOf, songTimeAt } from "./song-time";

/** What a feed needs of the world around it. */
export interface FeedWorld extends Pick<BlockWorld, "now" | "get"> {
  /** A block has come. */
  came(): void;
  /** What came is no block of this session. */
  unlike(fault: RangeError): void;
}

/** The pictures of a session: its blocks as they are pushed or fetched, and what they give at any moment. */
export class BlockFeed {
  readonly #manifest: Manifest;
  readonly #world: FeedWorld;
  readonly #player: BlockPlayer;
  readonly #keeper: BlockKeeper;

  constructor(hello: Hello, world: FeedWorld) {
    this.#manifest = hello;
    this.#world = world;
    this.#player = new BlockPlayer(hello, hello.blocks.revision);
    this.#keeper = new BlockKeeper(hello.links.session, hello.blocks, {
      now: () => world.now(),
      get: (href, signal) => world.get(href, signal),
      has: (number) => this.#player.has(number),
      take: (bytes) => this.take(bytes),
    });
  }

  /** Whether the frames that another `hello` tells of are laid out like these. */
  fits(hello: Hello): boolean {
    return layoutOf(hello) === layoutOf(this.#manifest);
  }

  /** The blocks are others, or elsewhere; those of before an edit are drawn until the present one has come. */
  follow(blocks: FrameBlocks): void {
    this.#player.follow(blocks.revision);
    this.#keeper.follow(blocks);
  }

  /** The server pushes anew what is needed now. */
  expect(): void {
    this.#keeper.expect();
  }

  /** Take a block's bytes in; those of another revision are dropped. */
  async take(bytes: ArrayBuffer): Promise<void> {
    try {
      if (revisionOf(bytes) !== this.#player.revision) return;
      this.#player.add(await unpackBlock(this.#manifest, bytes));
      this.#world.came();
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      this.#world.unlike(error);
    }
  }

  /** See that what is needed next is here or comes; `roundTrip` is null while the stream is down. */
  look(transport: TransportState, serverTime: number, duration: number, roundTrip: number | null): void {
    this.#keeper.look(blocksAhead(transport, serverTime, duration, this.#manifest.fps), roundTrip);
  }

  /** What was drawn last; null before the first picture. */
  get drawn(): PlayedFrame | null {
    return this.#player.drawn;
  }

  /** The picture at a moment of the server's clock; null until there was one. */
  frameAt(transport: TransportState, serverTime: number, duration: number): PlayedFrame | null {
    return this.#player.frameAt(transport, serverTime, duration);
  }

  /** Whether the picture of a moment is here. */
  isPictured(transport: TransportState, serverTime: number, duration: number): boolean {
    return this.#player.has(blockOf(frameOf(songTimeAt(transport, serverTime, duration), this.#manifest.fps)));
  }

  /** For how long from a moment on every picture is here, seconds; it is not looked further than 2.5. */
  ahead(transport: TransportState, serverTime: number, duration: number): number {
    const needed = blocksAhead(transport, serverTime, duration, this.#manifest.fps);
    return needed.find(({ number }) => !this.#player.has(number))?.comes ?? AHEAD_S;
  }

  /** Nothing more is fetched. */
  close(): void {
    this.#keeper.close();
  }
}

function layoutOf({ fps, frame_size, skeletons, parameters }: Manifest): string {
  return JSON.stringify([fps, frame_size, skeletons, parameters]);
}
