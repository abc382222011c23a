import { describe, expect, it } from "vitest";
import { sortFiles } from "./dropped-files";

const midi = new File(["MThd"], "Reverie.MID");
const audio = new File(["RIFF"], "take 3.wav");

describe("sortFiles", () => {
  it("tells score and song by their names", async () => {
    expect(await sortFiles([audio, midi])).toEqual({ score: midi, song: audio, show: null, unknown: [] });
  });

  it("tells a show from a score by what stands in the JSON", async () => {
    const show = new File(['{"version": 1, "tracks": {}}'], "lights.json");
    const score = new File(['{"parts": [], "notes": []}'], "tune.json");
    const tracksAndNotes = new File(['{"tracks": [], "notes": []}'], "both.json");
    expect(await sortFiles([show])).toMatchObject({ show, score: null });
    expect(await sortFiles([score])).toMatchObject({ show: null, score });
    expect(await sortFiles([tracksAndNotes])).toMatchObject({ score: tracksAndNotes });
  });

  it("takes the JSON of Tone.js's converter, whose tracks hold notes, for a score", async () => {
    const whole = new File(['{"header": {}, "tracks": [{"notes": []}]}'], "tone.json");
    const bare = new File(['{"tracks": [null, {"notes": []}]}'], "bare.json");
    expect(await sortFiles([whole])).toMatchObject({ show: null, score: whole });
    expect(await sortFiles([bare])).toMatchObject({ show: null, score: bare });
  });

  it("takes compressed files for scores", async () => {
    for (const name of ["tune.mid.gz", "Tune.ZIP", "song.kar"]) {
      const file = new File(["x"], name);
      expect(await sortFiles([file])).toMatchObject({ score: file, unknown: [] });
    }
  });

  it("leaves JSON that cannot be read to the server", async () => {
    const broken = new File(["{"], "broken.json");
    expect(await sortFiles([broken])).toMatchObject({ score: broken });
  });

  it("knows audio by its type where the name says nothing, and names what it cannot use", async () => {
    const recording = new File(["x"], "recording", { type: "audio/x-caf" });
    const picture = new File(["x"], "cover.png", { type: "image/png" });
    expect(await sortFiles([recording, picture])).toMatchObject({ song: recording, unknown: ["cover.png"] });
  });
});
