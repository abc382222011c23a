const HEADER_BYTES = 44;
/** Samples a second that tell enough of notes; fewer where the whole would be more than a server takes. */
const RATE = 22_050;
const LOWEST_RATE = 8000;
const MOST_BYTES = 190_000_000;

/** A song that this browser decoded, as WAV of one channel and 16 bits, to be listened to by the server. */
export async function monoWav(song: AudioBuffer): Promise<Blob> {
  const rate = Math.max(LOWEST_RATE, Math.min(RATE, Math.floor(MOST_BYTES / 2 / song.duration)));
  // The browser mixes the channels and filters what a lower rate cannot hold.
  const context = new OfflineAudioContext(1, Math.max(1, Math.round(song.duration * rate)), rate);
  const source = new AudioBufferSourceNode(context, { buffer: song });
  source.connect(context.destination);
  source.start();
  const mono = await context.startRendering();
  return wavOf(mono.getChannelData(0), rate);
}

/** Samples, −1…1, as WAV of 16 bits. */
export function wavOf(samples: Float32Array, rate: number): Blob {
  const bytes = new DataView(new ArrayBuffer(HEADER_BYTES + 2 * samples.length));
  const text = (at: number, letters: string): void => {
    for (const [index, letter] of Array.from(letters).entries()) bytes.setUint8(at + index, letter.charCodeAt(0));
  };
  text(0, "RIFF");
  bytes.setUint32(4, bytes.byteLength - 8, true);
  text(8, "WAVEfmt ");
  bytes.setUint32(16, 16, true);
  bytes.setUint16(20, 1, true);
  bytes.setUint16(22, 1, true);
  bytes.setUint32(24, rate, true);
  bytes.setUint32(28, 2 * rate, true);
  bytes.setUint16(32, 2, true);
  bytes.setUint16(34, 16, true);
  text(36, "data");
  bytes.setUint32(40, 2 * samples.length, true);
  samples.forEach((sample, index) => {
    const whole = Math.max(-32_768, Math.min(32_767, Math.round(sample * 32_768)));
    bytes.setInt16(HEADER_BYTES + 2 * index, whole, true);
  });
  return new Blob([bytes.buffer], { type: "audio/wav" });
}
