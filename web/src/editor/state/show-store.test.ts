import { describe, expect, it, vi } from "vitest";
import { ProblemError } from "../../connection";
import type { Edit } from "./edits";
import type { ShowDocument } from "./show-document";
import { ShowStore } from "./show-store.svelte";
import { TimeAxis } from "./time-axis";

const AXIS = new TimeAxis({ tempi: [{ onset_beats: 0, onset_s: 0, bpm: 120 }], bar_lines_s: [0, 2, 4] });
const FOV = "camera/fov";

const key = (key: string, time: number, value: number) => ({ key, time, value, interpolation: "linear" });
const shown = (...keyframes: ReturnType<typeof key>[]): ShowDocument => ({
  version: 1,
  title: "",
  time: "bars",
  tracks: [{ parameter: FOV, keyframes }],
});
const add = (name: string, time: number): Edit => ({
  edit: "add_keyframe",
  parameter: FOV,
  keyframe: key(name, time, 1),
});

/** A server with one show: it makes edits as the page expects them, refuses stale ones, and can be out of reach. */
class Server {
  document = shown(key("k1", 0, 0.5));
  revision = 0;
  undo = 0;
  reached = true;
  refuses: number | null = null;
  readonly asked: string[] = [];

  get etag(): string {
    return `"${this.revision}"`;
  }

  /** Somebody else's edit. */
  change(document: ShowDocument): void {
    this.document = document;
    this.revision += 1;
    this.undo += 1;
  }

  readonly request = async (
    method: string,
    path: string,
    options: { json?: unknown; ifMatch?: string } = {},
  ): Promise<Response> => {
    await Promise.resolve();
    this.asked.push(`${method} ${path}`);
    const fail = (status: number) => new ProblemError({ status, title: `status ${status}`, detail: "", errors: [] });
    if (!this.reached) throw fail(0);
    if (path === "show/history")
      return Response.json({ revision: this.revision, etag: this.etag, undo: this.undo, redo: 0 });
    if (method === "GET") return Response.json(this.document, { headers: { ETag: this.etag } });
    if (options.ifMatch !== this.etag) throw fail(412);
    if (this.refuses !== null) throw fail(this.refuses);
    if (path === "show/edits") {
      const added = (options.json as { keyframe: ReturnType<typeof key> }[]).map(({ keyframe }) => keyframe);
      const [track] = this.document.tracks;
      this.change(shown(...((track?.keyframes ?? []) as ReturnType<typeof key>[]), ...added));
    }
    const told = { revision: this.revision, etag: this.etag, undo: this.undo, redo: 0 };
    const { tracks, ...head } = this.document;
    return Response.json({ ...told, head, tracks, removed: [] });
  };
}

function opened() {
  const server = new Server();
  const told = { problems: vi.fn(), words: vi.fn() };
  const waiting: (() => void)[] = [];
  const store = new ShowStore({
    api: { request: server.request, sessionPath: (_, below) => below },
    session: "s",
    token: "t",
    axis: () => AXIS,
    tell: told.problems,
    word: told.words,
    later: (action) => waiting.push(action),
  });
  return { server, told, store, later: () => waiting.splice(0).forEach((action) => action()) };
}

const keysOf = (document: ShowDocument | null) => document?.tracks[0]?.keyframes.map((each) => each.key) ?? [];

describe("the show as the page holds it", () => {
  it("shows an edit at once, and is saved once the server has answered", async () => {
    const { server, store } = opened();
    await store.read();
    store.edit("Added", [add("k2", 1)]);
    expect(keysOf(store.document)).toEqual(["k1", "k2"]);
    expect(store.saving).toBe("saving");
    await vi.waitFor(() => expect(store.saving).toBe("saved"));
    expect(keysOf(server.document)).toEqual(["k1", "k2"]);
    expect(store.undoSteps).toBe(1);
    expect(store.etag).toBe(server.etag);
  });

  it("sends steps in their order, each on the state that the one before left", async () => {
    const { server, store, told } = opened();
    await store.read();
    store.edit("One", [add("k2", 1)]);
    store.edit("Two", [add("k3", 2)]);
    await vi.waitFor(() => expect(store.saving).toBe("saved"));
    expect(keysOf(server.document)).toEqual(["k1", "k2", "k3"]);
    expect(server.asked.filter((asked) => asked === "POST show/edits")).toHaveLength(2);
    expect(told.words).not.toHaveBeenCalled();
  });

  it("makes a late edit again on top of what somebody else did, and says so", async () => {
    const { server, store, told } = opened();
    await store.read();
    server.change(shown(key("theirs", 3, 0.1)));
    store.edit("Added", [add("k2", 1)]);
    await vi.waitFor(() => expect(store.saving).toBe("saved"));
    expect(keysOf(server.document)).toEqual(["theirs", "k2"]);
    expect(keysOf(store.document).sort()).toEqual(["k2", "theirs"]);
    expect(told.words).toHaveBeenCalledOnce();
    expect(told.problems).not.toHaveBeenCalled();
  });

  it("keeps what cannot be saved, says so, and saves it when the server is back", async () => {
    const { server, store, later } = opened();
    await store.read();
    server.reached = false;
    store.edit("Added", [add("k2", 1)]);
    await vi.waitFor(() => expect(store.saving).toBe("failed"));
    store.edit("Added", [add("k3", 2)]);
    expect(keysOf(store.document)).toEqual(["k1", "k2", "k3"]);
    later();
    await vi.waitFor(() => expect(store.saving).toBe("failed"));
    server.reached = true;
    store.retry();
    await vi.waitFor(() => expect(store.saving).toBe("saved"));
    expect(keysOf(server.document)).toEqual(["k1", "k2", "k3"]);
  });

  it("tells what the server refuses, takes it back on screen, and goes on with the rest", async () => {
    const { server, store, told } = opened();
    await store.read();
    server.refuses = 422;
    store.edit("Added", [add("k2", 1)]);
    await vi.waitFor(() => expect(store.saving).toBe("saved"));
    expect(told.problems).toHaveBeenCalledOnce();
    expect(keysOf(store.document)).toEqual(["k1"]);
    server.refuses = null;
    store.edit("Added", [add("k3", 1)]);
    await vi.waitFor(() => expect(store.saving).toBe("saved"));
    expect(keysOf(server.document)).toEqual(["k1", "k3"]);
  });

  it("follows what the stream tells of, and asks for nothing when that is its own edit", async () => {
    const { server, store } = opened();
    await store.read();
    server.change(shown(key("k1", 0, 0.5), key("theirs", 2, 1)));
    const state = () => ({ revision: server.revision, etag: server.etag, undo: server.undo, redo: 0 });
    await store.follow({ ...state(), path: null });
    expect(keysOf(store.document)).toEqual(["k1", "theirs"]);
    const asked = server.asked.length;
    await store.follow({ ...state(), path: null });
    expect(server.asked).toHaveLength(asked);
  });

  it("is not edited by who may only watch", async () => {
    const server = new Server();
    const store = new ShowStore({
      api: { request: server.request, sessionPath: (_, below) => below },
      session: "s",
      token: null,
      axis: () => AXIS,
      tell: vi.fn(),
      word: vi.fn(),
      later: vi.fn(),
    });
    await store.read();
    expect(store.editable).toBe(false);
    store.edit("Added", [add("k2", 1)]);
    expect(keysOf(store.document)).toEqual(["k1"]);
    expect(server.asked.some((asked) => asked.startsWith("POST"))).toBe(false);
  });
});
