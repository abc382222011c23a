import { describe, expect, it } from "vitest";

import { Latest } from "./latest";

interface Asked {
  readonly question: number;
  readonly answer: (value: string) => void;
  readonly refuse: (error: Error) => void;
}

function setup(): { latest: Latest<number, string>; asked: Asked[]; told: [string, number][]; failed: unknown[] } {
  const asked: Asked[] = [];
  const told: [string, number][] = [];
  const failed: unknown[] = [];
  const latest = new Latest<number, string>(
    (question) => new Promise((answer, refuse) => asked.push({ question, answer, refuse })),
    (answer, question) => told.push([answer, question]),
    (error) => failed.push(error),
  );
  return { latest, asked, told, failed };
}

const settle = (): Promise<void> => new Promise((done) => setTimeout(done));

describe("Latest", () => {
  it("asks one at a time and skips all but the newest that waits", async () => {
    const { latest, asked, told } = setup();
    for (const question of [1, 2, 3]) latest.put(question);
    expect(asked.map((one) => one.question)).toEqual([1]);
    asked[0]?.answer("one");
    await settle();
    expect(asked.map((one) => one.question)).toEqual([1, 3]);
    expect(latest.busy).toBe(true);
    asked[1]?.answer("three");
    await settle();
    expect(latest.busy).toBe(false);
    expect(told).toEqual([
      ["one", 1],
      ["three", 3],
    ]);
  });

  it("goes on after a refusal", async () => {
    const { latest, asked, told, failed } = setup();
    latest.put(1);
    latest.put(2);
    asked[0]?.refuse(new Error("no"));
    await settle();
    asked[1]?.answer("two");
    await settle();
    expect(failed).toHaveLength(1);
    expect(told).toEqual([["two", 2]]);
  });

  it("forgets what was dropped, and asks anew", async () => {
    const { latest, asked, told } = setup();
    latest.put(1);
    latest.drop();
    latest.put(2);
    asked[0]?.answer("one");
    await settle();
    asked[1]?.answer("two");
    await settle();
    expect(told).toEqual([["two", 2]]);
  });
});
