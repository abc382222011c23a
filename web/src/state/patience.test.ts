import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { GivenUpError, ProblemError, ReinaApi } from "../connection";
import { Patience } from "./patience.svelte";

const busy = (retryAfter: number | null): ProblemError =>
  new ProblemError({ status: 429, title: "Too Many Requests", detail: "", errors: [] }, retryAfter);

let patience: Patience;
beforeEach(() => {
  vi.useFakeTimers();
  patience = new Patience(() => Date.now() / 1000);
});
afterEach(() => vi.useRealTimers());

describe("Patience", () => {
  it("counts down to when a busy server is asked again, and says no more once it answers", async () => {
    const waited = vi.fn();
    void patience.wait(busy(5)).then(waited);
    expect(patience).toMatchObject({ title: "The server is busy", secondsLeft: 5 });
    await vi.advanceTimersByTimeAsync(3000);
    expect(patience.secondsLeft).toBe(2);
    expect(waited).not.toHaveBeenCalled();
    await vi.advanceTimersByTimeAsync(2000);
    expect(waited).toHaveBeenCalledOnce();
    expect(patience).toMatchObject({ title: "The server is busy", secondsLeft: 0 });
    await vi.advanceTimersByTimeAsync(2000);
    expect(patience.title).toBeNull();
  });

  it("asks at once where the person wants that, and not at all where they give it up", async () => {
    const now = patience.wait(busy(null));
    patience.tryNow();
    await now;
    const left = patience.wait(busy(30));
    patience.cancel();
    await expect(left).rejects.toBeInstanceOf(GivenUpError);
    expect(patience.title).toBeNull();
  });

  it("ends with what waits", async () => {
    const closed = new AbortController();
    const waits = patience.wait(busy(30), closed.signal);
    closed.abort(new Error("closed"));
    await expect(waits).rejects.toThrow("closed");
    await vi.advanceTimersByTimeAsync(2000);
    expect(patience.title).toBeNull();
  });
});

describe("ReinaApi", () => {
  function server(...statuses: number[]): { api: ReinaApi; asked: string[] } {
    const asked: string[] = [];
    const api = new ReinaApi("/api/v1", (_, init) => {
      asked.push(init?.method ?? "");
      const status = statuses.shift() ?? 200;
      return Promise.resolve(new Response("{}", { status, headers: { "Retry-After": "7" } }));
    });
    return { api, asked };
  }

  it("asks a busy server again for what changes nothing, after as long as it says", async () => {
    const { api, asked } = server(503, 429);
    const waits: (number | null)[] = [];
    api.whenBusy = ({ retryAfter }) => {
      waits.push(retryAfter);
      return Promise.resolve();
    };
    await api.session("a");
    expect(asked).toEqual(["GET", "GET", "GET"]);
    expect(waits).toEqual([7, 7]);
  });

  it("leaves it to the person to command again", async () => {
    const { api, asked } = server(503);
    api.whenBusy = () => Promise.resolve();
    await expect(api.control("a", { action: "play" }, "t")).rejects.toMatchObject({ status: 503 });
    expect(asked).toEqual(["POST"]);
  });
});
