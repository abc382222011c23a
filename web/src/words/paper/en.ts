import { filled, words } from "../words";

/** The part on paper and the fingering chart. */
export const paper = words("paper", {
  title: "The part on paper",
  panel: "the part on paper",
  part: "Part",
  fingerings: "Fingerings",
  chart: "Fingering chart",
  namesWritten: "Note names as written",
  namesSounding: "Note names as they sound",
  written: "Written",
  sounding: "Sounding",
  paper: "Paper",
  letter: "Letter",
  print: "Print",
  printOrPdf: "Print or PDF",
  writing: "Writing the part …",
  asWritten: filled("{part}, as written"),
  asItSounds: filled("{part}, as it sounds"),
  chartOf: filled("{instrument}: fingering chart"),
  chartWritten: "Notes as they are written for the instrument.",
  chartSounding: "Notes as they sound.",
  legend:
    "The usual fingering is large; those below it are alternates, the more usual first. " +
    "A filled circle is a valve that is down, valve 1 on the left.",
  legendPlayed: "A diamond marks the notes of this part.",
  inPart: "in this part",
  hidden: "hidden while the quiz asks for it",
  usual: filled("usual: {fingering}"),
  alternate: filled("alternate: {fingering}"),
  putAway: "Put the explanation away",
});
