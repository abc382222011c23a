import { counted, filled, words } from "../words";

/** What is said where the notes of a recording alone are looked for. */
export const transcribing = words("transcribe", {
  find: "Find its notes (a solo)",
  alone: "Where one instrument or voice alone is heard, its notes can be found.",
  listening: filled("Listening for the notes of {name}"),
  share: filled("{share} done. A minute of music takes a few seconds."),
  cancel: "Give it up",
  mix: filled("{name} is a mix"),
  mixMeans:
    "The notes of one line can be found, those of several at once cannot. Use a recording of the solo alone, or drop the score with the recording.",
  none: filled("No notes were found in {name}"),
  notInstalled: "The server cannot find notes yet",
  install: 'It needs one more package: pip install "reina[transcribe]", then start it again.',
  found: counted({ one: "{count} note found in {name}", other: "{count} notes found in {name}" }),
  noBeat: "No clear beat is heard: 120 beats a minute are written.",
  correct: "To correct them, download the MIDI file in the piece's panel, and drop it again with the recording.",
});
