import { readFileSync } from "node:fs";
import { beforeEach, describe, expect, it } from "vitest";
import type { FrameBlocks, Hello, Manifest } from "../generated/protocol";
import { BlockFeed } from "./block-feed";
import { sampleTransport } from "./sample-blocks";

const golden = new URL("../../../tests/golden/", import.meta.url);
const { manifest } = JSON.parse(readFileSync(new URL("frame_v1.json", golden), "utf8")) as { manifest: Manifest };
const BLOCK = new Uint8Array(readFileSync(new URL("block_v1_packed.bin", golden))).buffer;
const DURATION = 60;
/** In the golden block, which is the 40th. */
const THERE = sampleTransport({ playing: false, song_time_s: 40.5 });

const blocks: FrameBlocks = { revision: "0123456789abcdef", href: "/blocks", pushed: false };
const OTHERS: FrameBlocks = { ...blocks, revision: "00000000000000bb" };

let came: number;
let faults: string[];
let asked: string[];

beforeEach(() => {
  came = 0;
  faults = [];
  asked = [];
});

/** What a feed reads of `hello`, with the golden manifest. */
function helloOf(change: Partial<Manifest> = {}, told = blocks): Hello {
  return { ...manifest, ...change, blocks: told, links: { session: "/s" } } as unknown as Hello;
}

function feedOf(hello = helloOf()): BlockFeed {
  return new BlockFeed(hello, {
    now: () => 50,
    get: (href) => {
      asked.push(href);
      return Promise.resolve(BLOCK);
    },
    came: () => (came += 1),
    unlike: (fault) => faults.push(fault.message),
  });
}

describe("BlockFeed", () => {
  it("draws the block that has come", async () => {
    const feed = feedOf();
    expect(feed.isPictured(THERE, 100, DURATION)).toBe(false);
    await feed.take(BLOCK);
    expect(came).toBe(1);
    expect(feed.isPictured(THERE, 100, DURATION)).toBe(true);
    expect(feed.frameAt(THERE, 100, DURATION)).toMatchObject({ index: 2430, revision: blocks.revision });
    expect(feed.drawn?.index).toBe(2430);
  });

  it("says how far the picture goes on", async () => {
    const feed = feedOf();
    const playing = sampleTransport({ song_time_s: 40.2 });
    expect(feed.ahead(playing, 100, DURATION)).toBe(0);
    await feed.take(BLOCK);
    expect(feed.ahead(playing, 100, DURATION)).toBeCloseTo(0.8, 6);
    expect(feed.ahead(THERE, 100, DURATION)).toBe(2.5);
  });

  it("fetches what is missing", async () => {
    const feed = feedOf();
    feed.look(THERE, 100, DURATION, 0);
    expect(asked).toEqual(["/blocks/40"]);
    await expect.poll(() => feed.isPictured(THERE, 100, DURATION)).toBe(true);
  });

  it("drops blocks of before an edit, those too that are being unpacked", async () => {
    const feed = feedOf();
    const unpacking = feed.take(BLOCK);
    feed.follow(OTHERS);
    await unpacking;
    expect(feed.isPictured(THERE, 100, DURATION)).toBe(false);
    came = 0;
    await feed.take(BLOCK);
    expect([came, faults]).toEqual([0, []]);
  });

  it("keeps what is here where the same blocks are told again", async () => {
    const feed = feedOf();
    await feed.take(BLOCK);
    expect(feed.fits(helloOf())).toBe(true);
    feed.follow(blocks);
    expect(feed.isPictured(THERE, 100, DURATION)).toBe(true);
    expect(feed.fits(helloOf({ skeletons: manifest.skeletons.slice(1) }))).toBe(false);
  });

  it("tells what is no block of this session", async () => {
    const feed = feedOf(helloOf({ frame_size: 96 }));
    await feed.take(BLOCK);
    await feed.take(new ArrayBuffer(5));
    expect(faults).toEqual(["a block of frames of 184 bytes, and not of 96", "5 bytes are no packed block"]);
    expect(came).toBe(0);
  });
});
