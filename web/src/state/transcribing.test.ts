import { describe, expect, it } from "vitest";
import { ReinaApi } from "../connection";
import { Notices } from "./notices.svelte";
import { transcribed } from "./transcribing";
import { Uploads } from "./uploads.svelte";

const SONG = new File(["sound"], "solo.wav");

/** A server that answers with these states, one after the other, and says what it was asked. */
function server(states: readonly object[]): { api: ReinaApi; asked: string[] } {
  const asked: string[] = [];
  const waiting = [...states];
  const answer = (path: string, method = "GET"): Promise<Response> => {
    asked.push(`${method} ${path}`);
    if (method === "DELETE") return Promise.resolve(new Response(null, { status: 204 }));
    if (path.endsWith("score.mid")) return Promise.resolve(new Response("midi"));
    const { status = 200, ...state } = { id: "a", title: "solo", ...waiting.shift() } as { status?: unknown };
    const code = typeof status === "number" ? status : 200;
    return Promise.resolve(new Response(JSON.stringify({ status, ...state }), { status: code }));
  };
  const api = new ReinaApi(
    "/api/v1",
    (address, init) => answer(address instanceof Request ? address.url : address.toString(), init?.method),
    (method, path) => answer(path, method),
  );
  return { api, asked };
}

const at = (status: string, progress = 0, more: object = {}): object => ({
  status,
  progress,
  notes: 24,
  has_beat: true,
  fault: null,
  detail: null,
  ...more,
});
const soon = (): Promise<void> => Promise.resolve();

describe("a search for notes", () => {
  it("says how far it is, and brings the score", async () => {
    const { api, asked } = server([at("searching"), at("searching", 0.5), at("found", 1)]);
    const notices = new Notices();
    const told: string[] = [];
    const found = await transcribed(api, notices, new Uploads(), SONG, () => {
      told.push(notices.current?.detail ?? "");
      return soon();
    });
    expect(found).toMatchObject({ notes: 24, hasBeat: true });
    expect(found?.score.name).toBe("solo.mid");
    expect(told.map((each) => each.split(" ")[0])).toEqual(["0%", "50%"]);
    expect(notices.current).toBeNull();
    expect(asked.at(-1)).toBe("DELETE /api/v1/transcriptions/a");
  });

  it("can be given up", async () => {
    const { api, asked } = server([at("searching"), at("searching", 0.5)]);
    const notices = new Notices();
    const found = await transcribed(api, notices, new Uploads(), SONG, () => {
      notices.current?.actions[0]?.run();
      return soon();
    });
    expect(found).toBeNull();
    expect(asked).toEqual(["POST /api/v1/transcriptions", "DELETE /api/v1/transcriptions/a"]);
  });

  it("says that it cannot where the recording is a mix", async () => {
    const { api } = server([at("searching"), at("failed", 0, { fault: "mix", detail: "english" })]);
    const notices = new Notices();
    expect(await transcribed(api, notices, new Uploads(), SONG, soon)).toBeNull();
    expect(notices.current).toMatchObject({ kind: "problem", title: "solo.wav is a mix" });
  });

  it("says how to get what the server lacks", async () => {
    const problem = { status: 501, type: "urn:reina:problem:no-transcription", title: "x", detail: "y", errors: [] };
    const { api } = server([problem]);
    const notices = new Notices();
    expect(await transcribed(api, notices, new Uploads(), SONG, soon)).toBeNull();
    expect(notices.current?.detail).toContain('pip install "reina[transcribe]"');
  });

  it("tells any other problem as it is, and lets what else was said stand", async () => {
    const { api } = server([{ status: 418, type: "", title: "Busy", detail: "later", errors: [] }]);
    const notices = new Notices();
    expect(await transcribed(api, notices, new Uploads(), SONG, soon)).toBeNull();
    expect(notices.current).toMatchObject({ kind: "problem", title: "Busy" });

    const other = server([at("searching"), at("searching", 0.4), at("searching", 0.9), at("found", 1)]);
    await transcribed(other.api, notices, new Uploads(), SONG, () => {
      notices.say("word", "Something else");
      return soon();
    });
    expect(notices.current?.title).toBe("Something else");
  });
});
