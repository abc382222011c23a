/** Strength of the harmonics of a brass tone of middling loudness, the fundamental first. */
const HARMONICS = [0.7, 1, 0.85, 0.7, 0.5, 0.36, 0.24, 0.16, 0.1, 0.06];
const ATTACK_S = 0.035;
const HOLD_S = 0.45;
const RELEASE_S = 0.18;
const LOUDNESS = 0.28;

/**
 * Let a plain tone be heard: what a note should sound like.
 *
 * @param pitch MIDI number as it sounds.
 * @returns what ends it early.
 */
export function soundTone(context: AudioContext, out: AudioNode, pitch: number): () => void {
  const now = context.currentTime;
  const real = new Float32Array([0, ...HARMONICS]);
  const wave = context.createPeriodicWave(new Float32Array(real.length), real);
  const source = new OscillatorNode(context, { frequency: 440 * 2 ** ((pitch - 69) / 12) });
  source.setPeriodicWave(wave);
  const gain = new GainNode(context, { gain: 0 });
  gain.gain.setValueAtTime(0, now);
  gain.gain.linearRampToValueAtTime(LOUDNESS, now + ATTACK_S);
  gain.gain.setTargetAtTime(0, now + HOLD_S, RELEASE_S / 3);
  source.connect(gain).connect(out);
  source.onended = () => gain.disconnect();
  source.start(now);
  source.stop(now + HOLD_S + 2 * RELEASE_S);
  return () => {
    gain.gain.cancelScheduledValues(context.currentTime);
    gain.gain.setTargetAtTime(0, context.currentTime, 0.008);
    source.stop(context.currentTime + 0.05);
  };
}
