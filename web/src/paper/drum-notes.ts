import {
  Annotation,
  Articulation,
  Beam,
  Dot,
  Formatter,
  GraceNote,
  GraceNoteGroup,
  ModifierPosition,
  Parenthesis,
  StaveNote,
  Tuplet,
  Voice,
  type Stave,
  type SVGContext,
} from "vexflow/bravura";
import type { PartEntry, PartHead, PartMeasure } from "../generated/protocol";
import { DURATIONS, groupsOf, MAX_SLOPE, type Drawn } from "./engraved";

/** VexFlow's names of heads. */
const HEADS: Readonly<Record<PartHead["shape"], string>> = {
  plain: "",
  cross: "/x2",
  circled_cross: "/cx",
  diamond: "/d2",
  triangle: "/t2",
  slashed: "/sf",
};
const MARKS: Readonly<Record<NonNullable<PartHead["mark"]>, string | null>> = {
  accent: "a>",
  open: "ah",
  closed: "a+",
  half_open: null,
  choke: null,
};
/** Signs that are letters. */
const WORDS: Readonly<Partial<Record<NonNullable<PartHead["mark"]>, string>>> = { half_open: "ø", choke: "choke" };
const REST_PLACES = { alone: "b/4", hands: "e/5", feet: "d/4" };

/** Draw a measure of hands and feet: two voices, stems up and stems down. */
export function drawDrumMeasure(context: SVGContext, measure: PartMeasure, stave: Stave): Drawn[] {
  const voices = (["hands", "feet"] as const)
    .map((name) => measure.entries.filter(({ voice }) => voice === name))
    .filter((entries) => entries.length > 0);
  const drawn = voices.map((entries) =>
    entries.map((entry): Drawn => {
      const note = drumNote(entry, voices.length === 1);
      return { entry, note, graces: graceNotes(entry, note) };
    }),
  );
  const beams = drawn.flatMap((notes) => groupsOf(notes, ({ entry }) => entry.beam).map(beamOf));
  const tuplets = drawn.flatMap((notes) => groupsOf(notes, ({ entry }) => entry.tuplet).map(tupletOf));
  const ticked = drawn.map((notes) =>
    new Voice({ numBeats: measure.numerator, beatValue: measure.denominator })
      .setMode(Voice.Mode.SOFT)
      .addTickables(notes.map(({ note }) => note)),
  );
  new Formatter().joinVoices(ticked).formatToStave(ticked, stave);
  for (const voice of ticked) voice.draw(context, stave);
  for (const beam of beams) beam.setContext(context).draw();
  for (const tuplet of tuplets) tuplet.setContext(context).draw();
  return drawn.flat();
}

function beamOf(group: readonly Drawn[]): Beam {
  const beam = new Beam(group.map(({ note }) => note));
  Object.assign(beam.renderOptions, { minSlope: -MAX_SLOPE, maxSlope: MAX_SLOPE });
  return beam;
}

function tupletOf(group: readonly Drawn[]): Tuplet {
  const below = group[0]?.entry.voice === "feet";
  return new Tuplet(
    group.map(({ note }) => note),
    {
      numNotes: group.length > 4 ? 6 : 3,
      notesOccupied: group.length > 4 ? 4 : 2,
      ratioed: false,
      bracketed: group.some(({ entry }) => entry.beam === null),
      location: below ? Tuplet.LOCATION_BOTTOM : Tuplet.LOCATION_TOP,
    },
  );
}

function keyOf(head: PartHead): string {
  return `${head.letter.toLowerCase()}/${head.octave}${HEADS[head.shape]}`;
}

function drumNote(entry: PartEntry, alone: boolean): StaveNote {
  const duration = DURATIONS[entry.value] ?? "q";
  const { heads, dots } = entry;
  if (heads.length === 0) {
    const place = REST_PLACES[alone ? "alone" : (entry.voice ?? "hands")];
    const rest = new StaveNote({
      keys: [place],
      duration: `${entry.is_bar_rest ? "w" : duration}r`,
      dots,
      clef: "percussion",
      alignCenter: entry.is_bar_rest,
    });
    if (dots > 0) Dot.buildAndAttach([rest]);
    return rest;
  }
  const up = entry.voice !== "feet";
  const note = new StaveNote({
    keys: heads.map(keyOf),
    duration,
    dots,
    clef: "percussion",
    stemDirection: up ? 1 : -1,
  });
  for (let dot = 0; dot < dots; dot++) Dot.buildAndAttach([note], { all: true });
  const position = up ? ModifierPosition.ABOVE : ModifierPosition.BELOW;
  heads.forEach((head, at) => {
    if (head.is_ghost) {
      note.addModifier(new Parenthesis(ModifierPosition.LEFT), at);
      note.addModifier(new Parenthesis(ModifierPosition.RIGHT), at);
    }
    if (head.mark === null) return;
    const sign = MARKS[head.mark];
    if (sign !== null) note.addModifier(new Articulation(sign).setPosition(position), at);
    const word = WORDS[head.mark];
    if (word !== undefined) note.addModifier(new Annotation(word).setFont("Academico", 9), at);
  });
  return note;
}

function graceNotes(entry: PartEntry, note: StaveNote): readonly GraceNote[] {
  const graces = entry.graces.flatMap(({ head }) =>
    head === null
      ? []
      : [
          new GraceNote({
            keys: [keyOf(head)],
            duration: entry.graces.length > 1 ? "16" : "8",
            slash: entry.graces.length === 1,
            clef: "percussion",
            stemDirection: 1,
          }),
        ],
  );
  if (graces.length > 0) {
    const group = new GraceNoteGroup([...graces], true);
    note.addModifier(graces.length > 1 ? group.beamNotes() : group);
  }
  return graces;
}
