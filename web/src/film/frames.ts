/** The frames of a span over HTTP, a bounded piece at a time. */

import { ProblemError, type ReinaApi } from "../connection";
import { type Frame, FrameReader } from "../generated/frame";
import { HEADER_SIZE, type Hello } from "../generated/protocol";
import type { DrawnFrame } from "../scene";
import { type FrameSpan, countOf, piecesOf } from "./span";

/** Frames of a piece: one is drawn while the next is on its way, some three megabytes together. */
const MAX_IN_PIECE = 240;
/** A server that was restarted is there again within seconds. */
const TRIES = 6;
const PAUSE_MS = 1500;

/** A frame whose floats may be written to, until the next is asked for. */
export interface FilmFrame extends DrawnFrame {
  readonly floats: Float32Array;
}

/**
 * All frames of a span, in order, none left out.
 *
 * @param hello the manifest of the frames, at the span's rate.
 * @throws ProblemError when the server refuses them, or does not come back.
 * @throws RangeError when what comes does not fit the manifest.
 */
export async function* readFrames(
  api: ReinaApi,
  session: string,
  hello: Hello,
  span: FrameSpan,
  signal: AbortSignal,
): AsyncGenerator<FilmFrame> {
  const reader = new FrameReader(hello);
  const frame = reader.createFrame();
  const floats = new Float32Array(frame.words.buffer, HEADER_SIZE);
  const pieces = piecesOf(span, MAX_IN_PIECE);
  let coming = ask(pieces[0]);
  for (const [place, piece] of pieces.entries()) {
    const bytes = await coming;
    coming = ask(pieces[place + 1]);
    if (bytes === null || reader.open(bytes) !== countOf(piece)) {
      throw new RangeError(`The server sent other frames than the ${countOf(piece)} that were asked for`);
    }
    for (let number = 0; number < countOf(piece); number++) {
      signal.throwIfAborted();
      reader.read(number, frame);
      yield drawn(frame, floats);
    }
  }

  function ask(piece: FrameSpan | undefined): Promise<ArrayBuffer | null> {
    if (piece === undefined) return Promise.resolve(null);
    const bytes = fetchPiece(api, session, piece, signal);
    // It is waited for later; what goes wrong is told then.
    bytes.catch(() => undefined);
    return bytes;
  }
}

function drawn(frame: Frame, floats: Float32Array): FilmFrame {
  return { songTime: frame.songTimeS, index: frame.index, epoch: frame.epoch, playing: false, floats };
}

async function fetchPiece(api: ReinaApi, session: string, piece: FrameSpan, signal: AbortSignal): Promise<ArrayBuffer> {
  const { first, end, fps } = piece;
  const query = new URLSearchParams({ start_s: `${first / fps}`, end_s: `${end / fps}`, fps: `${fps}` });
  const path = `${api.sessionPath(session, "frames")}?${query.toString()}`;
  for (let tried = 1; ; tried++) {
    try {
      return await (await api.request("GET", path, { signal })).arrayBuffer();
    } catch (error) {
      const broken = error instanceof ProblemError ? error.status === 0 : error instanceof TypeError;
      if (signal.aborted || !broken || tried === TRIES) throw error;
      await new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
    }
  }
}
