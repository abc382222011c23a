import { describe, expect, it, vi } from "vitest";
import { GivenUpError, ProblemError, type Sending } from "../connection";
import { Uploads } from "./uploads.svelte";

const problem = (status: number): ProblemError => new ProblemError({ status, title: "no", detail: "why", errors: [] });

/** A server that takes an upload when it is told to. */
function held() {
  const tries: { sending: Sending; answer: (made: string) => void; refuse: (reason: Error) => void }[] = [];
  const task = (sending: Sending): Promise<string> =>
    new Promise((resolve, reject) => {
      sending.signal?.addEventListener("abort", () => reject(sending.signal?.reason as Error));
      tries.push({ sending, answer: resolve, refuse: reject });
    });
  return { tries, task };
}

describe("Uploads", () => {
  it("say how much has left, and when the server reads it", async () => {
    const { tries, task } = held();
    const uploads = new Uploads();
    const made = uploads.run("a.mid", task);
    const upload = uploads.all[0];
    expect(upload).toMatchObject({ name: "a.mid", phase: "sending", share: 0 });
    tries[0]?.sending.sent?.(25, 100);
    expect(upload).toMatchObject({ phase: "sending", share: 0.25, of: 100 });
    tries[0]?.sending.sent?.(100, 100);
    expect(upload?.phase).toBe("reading");
    tries[0]?.answer("session");
    expect(await made).toBe("session");
    expect(uploads.all).toEqual([]);
  });

  it("end at once when they are given up on their way", async () => {
    const { tries, task } = held();
    const uploads = new Uploads();
    const made = uploads.run("a.mid", task);
    tries[0]?.sending.sent?.(25, 100);
    expect(uploads.cancelLast()).toBe(true);
    await expect(made).rejects.toBeInstanceOf(GivenUpError);
    expect(tries[0]?.sending.signal?.aborted).toBe(true);
    expect(uploads.all).toEqual([]);
    expect(uploads.cancelLast()).toBe(false);
  });

  it("take back what the server makes of what was given up while it read it", async () => {
    const { tries, task } = held();
    const takeBack = vi.fn();
    const uploads = new Uploads();
    const made = uploads.run("a.mid", task, { takeBack });
    tries[0]?.sending.sent?.(100, 100);
    uploads.cancelLast();
    await expect(made).rejects.toBeInstanceOf(GivenUpError);
    expect(tries[0]?.sending.signal?.aborted).toBe(false);
    tries[0]?.answer("session");
    await vi.waitFor(() => expect(takeBack).toHaveBeenCalledExactlyOnceWith("session"));
  });

  it.each([0, 408, 429, 503, 507])("offer to send the same again after a %i", async (status) => {
    const { tries, task } = held();
    const uploads = new Uploads();
    const made = uploads.run("a.mid", task);
    tries[0]?.sending.sent?.(60, 100);
    tries[0]?.refuse(problem(status));
    const upload = uploads.all[0];
    await vi.waitFor(() => expect(upload?.phase).toBe("failed"));
    expect(upload?.problem?.status).toBe(status);
    upload?.sendAgain();
    await vi.waitFor(() => expect(tries).toHaveLength(2));
    expect(upload).toMatchObject({ phase: "sending", share: 0, problem: null });
    tries[1]?.answer("session");
    expect(await made).toBe("session");
  });

  it("can be left after a failure", async () => {
    const { tries, task } = held();
    const uploads = new Uploads();
    const made = uploads.run("a.mid", task);
    tries[0]?.refuse(problem(0));
    await vi.waitFor(() => expect(uploads.all[0]?.phase).toBe("failed"));
    uploads.cancelLast();
    await expect(made).rejects.toBeInstanceOf(GivenUpError);
    expect(uploads.all).toEqual([]);
  });

  it("are over where the server refuses them for good, or something else takes their place", async () => {
    const { tries, task } = held();
    const uploads = new Uploads();
    const refused = uploads.run("a.mid", task);
    tries[0]?.refuse(problem(413));
    await expect(refused).rejects.toMatchObject({ status: 413 });
    const other = new AbortController();
    const overtaken = uploads.run("b.mid", task, { signal: other.signal });
    other.abort();
    await expect(overtaken).rejects.toBeInstanceOf(GivenUpError);
    expect(uploads.all).toEqual([]);
  });
});
