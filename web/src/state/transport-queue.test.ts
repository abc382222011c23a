import { describe, expect, it } from "vitest";
import type { TransportCommand, TransportState } from "../generated/protocol";
import { TransportQueue } from "./transport-queue";

const STATE: TransportState = {
  playing: false,
  song_time_s: 0,
  server_time_s: 0,
  rate: 1,
  loop: null,
  count_in_s: 0,
  epoch: 0,
};

/** A server that answers when it is told to. */
function slowServer() {
  const sent: TransportCommand[] = [];
  const answers: ((state: TransportState | null) => void)[] = [];
  const queue = new TransportQueue((command) => {
    sent.push(command);
    return new Promise((resolve) => answers.push(resolve));
  });
  const answer = async (state: TransportState | null = STATE): Promise<void> => {
    answers.shift()?.(state);
    await Promise.resolve();
    await Promise.resolve();
    await Promise.resolve();
  };
  return { sent, queue, answer };
}

describe("TransportQueue", () => {
  it("adds up what is asked for before the server has answered", async () => {
    const { sent, queue, answer } = slowServer();
    const all = [2, 4, 6, 8].map((song_time_s) => queue.add({ action: "seek", song_time_s }));
    expect(queue.asked.songTime).toBe(8);
    expect(sent).toEqual([{ action: "seek", song_time_s: 2 }]);
    await answer();
    expect(sent.slice(1)).toEqual([{ action: "seek", song_time_s: 8 }]);
    await answer();
    await Promise.all(all);
    expect(queue.asked).toEqual({});
  });

  it("keeps commands of different kinds in their order", async () => {
    const { sent, queue, answer } = slowServer();
    void queue.add({ action: "play" });
    void queue.add({ action: "seek", song_time_s: 3 });
    void queue.add({ action: "pause" });
    expect(queue.asked).toEqual({ playing: false, songTime: 3 });
    for (let count = 0; count < 3; count += 1) await answer();
    expect(sent.map(({ action }) => action)).toEqual(["play", "seek", "pause"]);
  });

  it("forgets what waits behind a refusal", async () => {
    const { sent, queue, answer } = slowServer();
    const first = queue.add({ action: "rate", rate: 2 });
    void queue.add({ action: "play" });
    await answer(null);
    await first;
    expect(sent).toHaveLength(1);
    expect(queue.asked).toEqual({});
  });
});
