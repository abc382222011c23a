import { beforeEach, describe, expect, it } from "vitest";
import type { FrameBlocks } from "../generated/protocol";
import { BlockKeeper } from "./block-keeper";
import { ProblemError } from "./problem";

const OWN = "/api/v1/sessions/s";
const PUSHED: FrameBlocks = { revision: "aa", href: `${OWN}/blocks/aa`, pushed: true };
const ELSEWHERE: FrameBlocks = { revision: "aa", href: "https://blocks.example/aa", pushed: false };

/** One request under the test's hand. */
interface Asked {
  readonly href: string;
  readonly signal: AbortSignal;
  answer(number?: number): Promise<void>;
  fail(status: number): Promise<void>;
}

/** The round trip of a room's own network, seconds. */
const NEAR = 0.001;

let now: number;
let here: Set<number>;
let asked: Asked[];

beforeEach(() => {
  now = 50;
  here = new Set();
  asked = [];
});

function keeperOf(blocks: FrameBlocks): BlockKeeper {
  return new BlockKeeper(OWN, blocks, {
    now: () => now,
    has: (number) => here.has(number),
    take: (bytes) => {
      here.add(new Uint8Array(bytes)[0] ?? -1);
      return Promise.resolve();
    },
    get: (href, signal) =>
      new Promise((resolve, reject) => {
        asked.push({
          href,
          signal,
          answer: (number = Number(href.split("/").at(-1))) => settled(() => resolve(new Uint8Array([number]).buffer)),
          fail: (status) => settled(() => reject(new ProblemError({ status, title: "no", detail: "", errors: [] }))),
        });
      }),
  });
}

/** Answer, and wait until all that follows has happened. */
async function settled(answer: () => void): Promise<void> {
  answer();
  await new Promise((resolve) => setTimeout(resolve));
}

/** Blocks one a second from a number on, the first of them there. */
function from(number: number, count = 3): { number: number; comes: number }[] {
  return Array.from({ length: count }, (_, place) => ({ number: number + place, comes: Math.max(place - 0.3, 0) }));
}

function at(place: number): Asked {
  const request = asked[place];
  if (request === undefined) throw new Error(`nothing was asked for at ${place}`);
  return request;
}

const hrefs = (): string[] => asked.map(({ href }) => href);

describe("BlockKeeper, where blocks are pushed", () => {
  it("fetches nothing that is here or not yet due", () => {
    here.add(4);
    keeperOf(PUSHED).look(from(4), NEAR);
    expect(asked).toEqual([]);
  });

  it("fetches what is missing shortly before it is due, once", async () => {
    here.add(4);
    const keeper = keeperOf(PUSHED);
    const needed = [
      { number: 4, comes: 0 },
      { number: 5, comes: 0.45 },
      { number: 6, comes: 1.45 },
    ];
    keeper.look(needed, NEAR);
    keeper.look(needed, NEAR);
    expect(hrefs()).toEqual([`${OWN}/blocks/aa/5`]);
    await at(0).answer();
    keeper.look(needed, NEAR);
    expect(here.has(5)).toBe(true);
    expect(asked).toHaveLength(1);
  });

  it("fetches behind a slow network sooner, by two round trips", () => {
    const keeper = keeperOf(PUSHED);
    const needed = [{ number: 5, comes: 1 }];
    keeper.look(needed, 0.2);
    expect(asked).toEqual([]);
    keeper.look(needed, 0.3);
    expect(asked).toHaveLength(1);
  });

  it("gives what is pushed anew a moment and a round trip", () => {
    const keeper = keeperOf(PUSHED);
    keeper.expect();
    now += 0.49;
    keeper.look(from(4, 1), 0.2);
    expect(asked).toEqual([]);
    now += 0.02;
    keeper.look(from(4, 1), 0.2);
    expect(hrefs()).toEqual([`${OWN}/blocks/aa/4`]);
  });

  it("asks nobody while there is no connection", () => {
    keeperOf(PUSHED).look(from(4), null);
    expect(asked).toEqual([]);
  });
});

describe("BlockKeeper, where blocks are not pushed", () => {
  it("fetches all ahead of time, at most three at once, the soonest first", async () => {
    const keeper = keeperOf(ELSEWHERE);
    keeper.expect();
    keeper.look(from(4, 5), null);
    expect(hrefs()).toEqual([4, 5, 6].map((number) => `${ELSEWHERE.href}/${number}`));
    await at(1).answer();
    keeper.look(from(4, 5), null);
    expect(hrefs().slice(3)).toEqual([`${ELSEWHERE.href}/7`]);
  });

  it.each([0, 503, 404])("goes to the session's own origin where the other fails with %d", async (status) => {
    const keeper = keeperOf(ELSEWHERE);
    keeper.look(from(4, 1), NEAR);
    await at(0).fail(status);
    expect(hrefs()).toEqual([`${ELSEWHERE.href}/4`, `${OWN}/blocks/aa/4`]);
    await at(1).answer();
    expect(here.has(4)).toBe(true);
    keeper.look(from(5, 1), NEAR);
    expect(hrefs().at(-1)).toBe(`${OWN}/blocks/aa/5`);
    keeper.follow({ ...ELSEWHERE, revision: "bb" });
    keeper.look(from(6, 1), NEAR);
    expect(hrefs().at(-1)).toBe(`${ELSEWHERE.href}/6`);
  });

  it("waits a while where nobody answers, and where something else came", async () => {
    const keeper = keeperOf(ELSEWHERE);
    keeper.look(from(4, 1), NEAR);
    await at(0).fail(0);
    await at(1).fail(0);
    keeper.look(from(4, 1), NEAR);
    expect(asked).toHaveLength(2);
    now += 1.1;
    keeper.look(from(4, 1), NEAR);
    expect(asked).toHaveLength(3);
    await at(2).answer(9);
    keeper.look(from(4, 1), NEAR);
    expect(asked).toHaveLength(3);
  });

  it("waits for the next revision where this one is gone", async () => {
    const keeper = keeperOf(ELSEWHERE);
    keeper.look(from(4, 1), NEAR);
    await at(0).fail(410);
    now += 100;
    keeper.look(from(4), NEAR);
    expect(asked).toHaveLength(1);
    keeper.follow({ revision: "bb", href: "https://blocks.example/bb", pushed: false });
    keeper.look(from(4, 1), NEAR);
    expect(hrefs()[1]).toBe("https://blocks.example/bb/4");
  });

  it("gives up what is on its way with its revision, and drops it if it comes", async () => {
    const keeper = keeperOf(ELSEWHERE);
    keeper.look(from(4, 1), NEAR);
    keeper.follow({ revision: "bb", href: "https://blocks.example/bb", pushed: false });
    expect(at(0).signal.aborted).toBe(true);
    await at(0).answer();
    expect(here.has(4)).toBe(false);
    keeper.look(from(4, 1), NEAR);
    expect(hrefs()[1]).toBe("https://blocks.example/bb/4");
  });

  it("ends with the page", () => {
    const keeper = keeperOf(ELSEWHERE);
    keeper.look(from(4, 1), NEAR);
    keeper.close();
    expect(at(0).signal.aborted).toBe(true);
    keeper.look(from(5, 1), NEAR);
    expect(asked).toHaveLength(1);
  });
});
