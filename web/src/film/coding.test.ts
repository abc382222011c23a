import { describe, expect, it } from "vitest";

import { type AudioCodec, type VideoCodec, bitRate, chooseCoding, codingName } from "./coding";

const browser = (video: VideoCodec[], audio: AudioCodec[]) => ({ video: new Set(video), audio: new Set(audio) });
const CHROME = browser(["avc", "vp9", "av1"], ["aac", "opus"]);
const CHROMIUM_ON_LINUX = browser(["avc", "vp9", "av1"], ["opus"]);
const FREE = browser(["av1", "vp9"], ["opus"]);
const SAFARI = browser(["avc"], ["aac"]);

describe("the coding of a film", () => {
  it.each([
    ["all there is", CHROME, true, null, "MP4, H.264 and AAC"],
    ["no AAC", CHROMIUM_ON_LINUX, true, null, "MP4, H.264 and Opus"],
    ["no H.264", FREE, true, null, "WebM, VP9 and Opus"],
    ["AV1 alone", browser(["av1"], ["opus"]), true, null, "WebM, AV1 and Opus"],
    ["no Opus", SAFARI, true, null, "MP4, H.264 and AAC"],
    ["VP9 and no Opus", browser(["vp9"], ["aac"]), true, null, "MP4, VP9 and AAC"],
    ["without sound", CHROME, false, null, "MP4, H.264, silent"],
    ["no sound at all", browser(["vp9"], []), false, null, "WebM, VP9, silent"],
    ["asked for MP4", FREE, true, "mp4", "MP4, VP9 and Opus"],
    ["asked for WebM", CHROME, true, "webm", "WebM, VP9 and Opus"],
  ] as const)("%s", (_, encoders, sound, container, name) => {
    const coding = chooseCoding(encoders, sound, container);
    expect(coding === null ? null : codingName(coding)).toBe(name);
  });

  it.each([
    ["nothing", browser([], ["aac", "opus"]), true, null],
    ["no sound", browser(["avc"], []), true, null],
    ["WebM where there is none", SAFARI, true, "webm"],
  ] as const)("is none with %s", (_, encoders, sound, container) => {
    expect(chooseCoding(encoders, sound, container)).toBeNull();
  });
});

describe("the bits of a film", () => {
  const hd = { width: 1920, height: 1080 };

  it("are the table's at 1080p and 30 frames a second", () => {
    expect(bitRate("small", hd, 30, "avc")).toBe(3e6);
    expect(bitRate("good", hd, 30, "avc")).toBe(8e6);
    expect(bitRate("best", hd, 30, "avc")).toBe(20e6);
    expect(bitRate("good", hd, 30, "vp9")).toBe(5.6e6);
  });

  it("grow with the picture and the frames, but not as much", () => {
    const ultra = bitRate("good", { width: 3840, height: 2160 }, 60, "avc");
    expect(ultra).toBeGreaterThan(4 * 8e6);
    expect(ultra).toBeLessThan(8 * 8e6);
  });
});
