import type { Manifest } from "../generated/protocol";

/** A small manifest for tests: two joints, one skeleton, a number, a choice and an orientation. */
export const SAMPLE_MANIFEST: Manifest = {
  protocol: "reina.v1",
  fps: 60,
  frame_size: 96,
  skeletons: [{ name: "player", player: 0, rig: "trumpeter", joints: ["hips", "spine"], offset: 24, root_offset: 56 }],
  parameters: [
    { path: "lights/key/intensity", type: "number", offset: 72, length: 1, blend: true },
    { path: "camera/shot", type: "choice", offset: 76, length: 1, blend: false },
    { path: "stage/orientation", type: "orientation", offset: 80, length: 4, blend: true },
  ],
};

/** One frame of the sample manifest. */
export interface SampleFrame {
  epoch?: number;
  flags?: number;
  index: number;
  due: number;
  floats?: readonly number[];
}

const FLOATS = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1];

/** The bytes of frames of the sample manifest, back to back, as the server would send them. */
export function encodeSampleFrames(...frames: SampleFrame[]): ArrayBuffer {
  const size = SAMPLE_MANIFEST.frame_size;
  const bytes = new ArrayBuffer(size * frames.length);
  frames.forEach((frame, place) => {
    const view = new DataView(bytes, place * size, size);
    view.setUint8(0, 1);
    view.setUint8(1, frame.epoch ?? 0);
    view.setUint16(2, frame.flags ?? 1, true);
    view.setUint32(4, frame.index, true);
    view.setFloat64(8, frame.index / SAMPLE_MANIFEST.fps, true);
    view.setFloat64(16, frame.due, true);
    (frame.floats ?? FLOATS).forEach((value, i) => view.setFloat32(24 + 4 * i, value, true));
  });
  return bytes;
}
