/** Single frames of a session over HTTP, with parameters set over those of its show. */

import { ReinaApi } from "../connection";
import { type Frame, FrameReader } from "../generated/frame";
import { HEADER_SIZE, type Hello, type Score } from "../generated/protocol";
import type { DrawnFrame } from "../scene";
import type { Overrides } from "./choices";

export class SessionFrames {
  readonly manifest: Hello;
  readonly score: Score;
  readonly #api: ReinaApi;
  readonly #id: string;
  readonly #reader: FrameReader;
  readonly #frame: Frame;
  #epoch = 0;

  private constructor(api: ReinaApi, id: string, manifest: Hello, score: Score) {
    this.#api = api;
    this.#id = id;
    this.manifest = manifest;
    this.score = score;
    this.#reader = new FrameReader(manifest);
    this.#frame = this.#reader.createFrame();
  }

  /** Open a session, or the server's first example where `id` is null. */
  static async open(id: string | null): Promise<SessionFrames> {
    const api = new ReinaApi();
    const session = id ?? (await openExample(api));
    const path = api.sessionPath(session, "manifest");
    const [manifest, score] = await Promise.all([api.request("GET", path), api.score(session)]);
    return new SessionFrames(api, session, (await manifest.json()) as Hello, score);
  }

  /** The frame at a song time, seconds, with some parameters overridden. */
  async at(songTime: number, overrides: Overrides): Promise<DrawnFrame> {
    const { fps } = this.manifest;
    const index = Math.max(0, Math.round(songTime * fps));
    const span = `start_s=${index / fps}&end_s=${(index + 0.5) / fps}&fps=${fps}`;
    const answer = await this.#api.request("GET", `${this.#api.sessionPath(this.#id, "frames")}?${span}`);
    this.#reader.open(await answer.arrayBuffer());
    const frame = this.#frame;
    this.#reader.read(0, frame);
    for (const [path, floats] of Object.entries(overrides)) {
      frame.parameters[this.#reader.parameterIndex(path)]?.set(floats);
    }
    const floats = new Float32Array(frame.words.buffer, HEADER_SIZE);
    // Each is another edit of the show, so that it is drawn though it may be the same frame.
    this.#epoch += 1;
    return { songTime: frame.songTimeS, index: frame.index, epoch: this.#epoch, playing: false, floats };
  }
}

async function openExample(api: ReinaApi): Promise<string> {
  const example = (await api.examples())[0];
  if (example === undefined)
    throw new Error("The server has no example; give the gallery a session: /gallery?session=…");
  return (await api.createSession({ score: await api.file(example.score) })).id;
}
