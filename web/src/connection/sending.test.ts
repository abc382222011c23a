import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { send } from "./sending";

/** A request under the test's hand. */
class HeldRequest {
  static made: HeldRequest[] = [];
  readonly upload: {
    onprogress?: (event: { loaded: number; total: number }) => void;
    onload?: (event: { loaded: number }) => void;
  } = {};
  readonly headers: Record<string, string> = {};
  status = 0;
  responseText = "";
  aborted = false;
  onload?: () => void;
  onerror?: () => void;
  onloadend?: () => void;
  constructor() {
    HeldRequest.made.push(this);
  }
  open(): void {
    return;
  }
  send(): void {
    return;
  }
  setRequestHeader(name: string, value: string): void {
    this.headers[name] = value;
  }
  getAllResponseHeaders(): string {
    return "content-type: application/problem+json\r\nretry-after: 5\r\n";
  }
  abort(): void {
    this.aborted = true;
  }
}

const last = (): HeldRequest => {
  const request = HeldRequest.made.at(-1);
  if (request === undefined) throw new Error("nothing was sent");
  return request;
};

beforeEach(() => vi.stubGlobal("XMLHttpRequest", HeldRequest));
afterEach(() => vi.unstubAllGlobals());

describe("send", () => {
  it("tells how much has left, and answers as fetch does", async () => {
    const told: number[][] = [];
    const sent = (...bytes: [number, number]): number => told.push(bytes);
    const answer = send("POST", "/x", { headers: { Accept: "a" }, body: "b", sent });
    const request = last();
    expect(request.headers).toEqual({ Accept: "a" });
    request.upload.onprogress?.({ loaded: 40, total: 100 });
    request.upload.onload?.({ loaded: 100 });
    request.status = 503;
    request.responseText = '{"title":"t"}';
    request.onload?.();
    expect(told).toEqual([
      [40, 100],
      [100, 100],
    ]);
    const response = await answer;
    expect([response.status, response.headers.get("Retry-After"), await response.json()]).toEqual([
      503,
      "5",
      { title: "t" },
    ]);
  });

  it("has no body in an answer that may have none", async () => {
    const answer = send("PUT", "/x", { headers: {}, body: "b" });
    last().status = 204;
    last().onload?.();
    expect((await answer).body).toBeNull();
  });

  it("ends with its signal, and where no answer comes", async () => {
    const ended = new AbortController();
    const given = send("POST", "/x", { headers: {}, body: "b", signal: ended.signal });
    ended.abort(new Error("given up"));
    await expect(given).rejects.toThrow("given up");
    expect(last().aborted).toBe(true);
    const lost = send("POST", "/x", { headers: {}, body: "b" });
    last().onerror?.();
    await expect(lost).rejects.toBeInstanceOf(TypeError);
  });
});
