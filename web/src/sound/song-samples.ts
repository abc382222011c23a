import type { Part } from "./song-parts";
import type { SongSource } from "./song-source";
import { CROSSFADE_S } from "./voice";

/**
 * The samples of a part of a song, one array a channel; `count` of them, from the part's begin on.
 *
 * @param faded the part before it ended where this begins: they are faded into each other as voices are, this far
 *   into it, by what the segment before holds of it
 */
export function samplesOf(
  song: SongSource,
  part: Part,
  count: number,
  before: AudioBuffer | null,
): Float32Array<ArrayBuffer>[] {
  const buffer = song.at(part.segment);
  if (buffer === null) throw new RangeError(`segment ${part.segment} is not decoded`);
  const { sampleRate } = buffer;
  const first = placeIn(song, part.segment, part.begin, sampleRate);
  const channels = Array.from({ length: buffer.numberOfChannels }, (_, channel) => {
    const samples = new Float32Array(count);
    samples.set(buffer.getChannelData(channel).subarray(first, first + count));
    return samples;
  });
  if (before !== null) fadeFrom(before, placeIn(song, part.segment - 1, part.begin, sampleRate), channels);
  return channels;
}

/** The sample of a segment's buffer at which a place of the song lies. */
function placeIn(song: SongSource, segment: number, position: number, sampleRate: number): number {
  return Math.max(Math.round((position - segment * song.segmentLength + song.overlap) * sampleRate), 0);
}

/** Fade from what the segment before holds of the first moments. */
function fadeFrom(before: AudioBuffer, from: number, channels: readonly Float32Array[]): void {
  const length = Math.round((CROSSFADE_S / 2) * before.sampleRate);
  channels.forEach((samples, channel) => {
    const earlier = before.getChannelData(channel);
    for (let index = 0; index < Math.min(length, samples.length); index += 1) {
      const share = (index + 1) / (length + 1);
      samples[index] = (samples[index] ?? 0) * share + (earlier[from + index] ?? 0) * (1 - share);
    }
  });
}
