const PITCH_HZ = 1600;
const LONG_S = 0.03;

/** A short click into a node at a context time, seconds. */
export function playClick(context: AudioContext, into: AudioNode, when: number): void {
  const tone = new OscillatorNode(context, { frequency: PITCH_HZ });
  const gain = new GainNode(context, { gain: 0 });
  gain.gain.setValueAtTime(0.8, when);
  gain.gain.exponentialRampToValueAtTime(0.001, when + LONG_S);
  gain.gain.setValueAtTime(0, when + LONG_S);
  tone.connect(gain).connect(into);
  tone.start(when);
  tone.stop(when + LONG_S);
  tone.onended = () => gain.disconnect();
}
