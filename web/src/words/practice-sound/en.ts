import { filled, words } from "../words";

/** How the person hears their part and everything else. */
export const practiceSound = words("practice-sound", {
  heading: "What you hear",
  headingMeans: "Only here: nobody else hears another sound for it",
  partOf: filled("{part} and the rest"),
  asWritten: "As written",
  without: "Without",
  withoutMeans: "Everything but this part: play it yourself",
  louder: "Louder",
  louderMeans: "The rest is turned down to a quarter",
  alone: "Alone",
  aloneMeans: "This part, and nothing else",
  balance: "Between the rest and the part",
  restPercent: filled("The rest at {share}"),
  partPercent: filled("The part at {share}"),
  pitch: "Everything sounds",
  pitchMeans: "In semitones, without the drums; the fingering stays as it is",
  lower: "A semitone lower",
  higher: "A semitone higher",
  asNotated: "as written",
  semitonesHigher: filled("{count} higher"),
  semitonesLower: filled("{count} lower"),
  recording: "A recording is heard as it is: its parts cannot be told apart, nor moved",
  pitchGoes: "The pitch goes with the speed: this browser cannot keep it",
  pitchNeedsHttps:
    "The pitch goes with the speed: browsers keep it only at an address with https, or on the server's own computer",
});
