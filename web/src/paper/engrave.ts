import {
  Accidental,
  Articulation,
  Barline,
  Beam,
  Dot,
  Formatter,
  GraceNote,
  GraceNoteGroup,
  MultiMeasureRest,
  Ornament,
  Renderer,
  Stave,
  StaveNote,
  StaveTie,
  SVGContext,
  Tuplet,
  Voice,
} from "vexflow/bravura";
import "./notation.css";
import type { PartEntry, PartMeasure, PartPitch, PartTempo, WrittenPart } from "../generated/protocol";
import { isAlternate } from "../state/alternate";
import { noteName } from "../words";
import { drawDrumMeasure } from "./drum-notes";
import { drawHands } from "./drum-hands";
import { DURATIONS, groupsOf, MAX_SLOPE, type Drawn } from "./engraved";
import { fingeringText } from "./fingering";
import { fifthsOf, INDENT, type Placed, type Reading, type System } from "./layout";
import { centred, label, rectangle } from "./lettering";
import { staffPlace } from "./staff";

const MAJOR_KEYS = ["Cb", "Gb", "Db", "Ab", "Eb", "Bb", "F", "C", "G", "D", "A", "E", "B", "F#", "C#"];
const SIGNS = { flat: "b", natural: "n", sharp: "#" };
const REST_PLACES = { treble: "b/4", bass: "d/3", percussion: "b/4" };
/** Of a metronome mark, as the music's font has them. */
const [HALF, QUARTER, DOT] = ["\uECA3", "\uECA5", "\uECB7"];
const [DOUBLE_BAR, FINAL_BAR] = [Barline.type.DOUBLE, Barline.type.END];

/** The music's own font, and its text's: nothing is measured rightly before they are there. */
export async function fontsReady(): Promise<void> {
  await Promise.all(["30px Bravura", "12px Academico", "bold 12px Academico"].map((font) => document.fonts.load(font)));
}

export interface Engraving {
  /** How much larger than in the staff's units it is drawn. */
  readonly zoom: number;
  readonly reading: Reading;
}

/**
 * Draw one system of a part into an element, as SVG.
 *
 * What belongs to a note of the part has `data-note`, its place in `part.notes`, and what a pointer meets of it is
 * the whole height of the staff; `data-measure` is on what lies between.
 */
export function engraveSystem(
  into: HTMLElement,
  part: WrittenPart,
  system: System,
  width: number,
  { zoom, reading }: Engraving,
): void {
  into.replaceChildren();
  // VexFlow looks its own elements up by their ids, so that they must be in the document while it draws.
  const holder = document.createElement("div");
  into.append(holder);
  const renderer = new Renderer(holder, Renderer.Backends.SVG);
  renderer.resize(width * zoom, system.height * zoom);
  const context = renderer.getContext();
  if (!(context instanceof SVGContext)) throw new TypeError("VexFlow draws no SVG here");
  context.scale(zoom, zoom);
  const drawn: Drawn[] = [];
  let x = INDENT;
  for (const [at, placed] of system.measures.entries()) {
    const measure = part.measures[placed.index];
    if (measure === undefined) continue;
    drawn.push(...drawMeasure(context, part, measure, placed, { x, top: system.top, first: at === 0 }, reading));
    x += placed.width;
  }
  drawTies(context, drawn);
  for (const tempo of part.tempi) drawTempo(context, part, system, drawn, tempo);
  if (part.clef === "percussion") drawHands(context.svg, part, system, drawn);
  else drawFingerings(context.svg, part, system, drawn);
  const picture = context.svg;
  picture.setAttribute("viewBox", `0 0 ${width} ${system.height}`);
  picture.setAttribute("role", "group");
  into.replaceChildren(picture);
}

interface At {
  readonly x: number;
  readonly top: number;
  readonly first: boolean;
}

function drawMeasure(
  context: SVGContext,
  part: WrittenPart,
  measure: PartMeasure,
  placed: Placed,
  { x, top, first }: At,
  reading: Reading,
): Drawn[] {
  const fifths = fifthsOf(measure, reading);
  const before = part.measures[placed.index - 1];
  const stave = new Stave(x, top - 40, placed.width);
  if (first) stave.addClef(part.clef);
  if (first || placed.showsKey) {
    const cancelled = placed.showsKey && before !== undefined ? keyName(fifthsOf(before, reading)) : undefined;
    if (fifths !== 0 || placed.showsKey) stave.addKeySignature(keyName(fifths), cancelled);
  }
  if (placed.showsMetre) stave.addTimeSignature(`${measure.numerator}/${measure.denominator}`);
  if (first && measure.number > 1) stave.setMeasure(measure.number);
  const next = part.measures[placed.index + 1];
  if (next === undefined) stave.setEndBarType(FINAL_BAR);
  else if (fifthsOf(next, reading) !== fifths) stave.setEndBarType(DOUBLE_BAR);
  stave.setContext(context).draw();
  if (measure.bars > 1) {
    new MultiMeasureRest(measure.bars, { numberOfMeasures: measure.bars }).setStave(stave).setContext(context).draw();
    return [];
  }
  if (part.clef === "percussion") return drawDrumMeasure(context, measure, stave);
  const notes = measure.entries.map((entry): Drawn => {
    const note = staveNote(part, entry, reading);
    return { entry, note, graces: graceNotes(part, entry, note, reading) };
  });
  const tuplets = groupsOf(notes, ({ entry }) => entry.tuplet).map(
    (group) =>
      new Tuplet(
        group.map(({ note }) => note),
        {
          numNotes: group.length > 4 ? 6 : 3,
          notesOccupied: group.length > 4 ? 4 : 2,
          ratioed: false,
          bracketed: group.some(({ entry }) => entry.beam === null),
        },
      ),
  );
  const beams = groupsOf(notes, ({ entry }) => entry.beam).map((group) => {
    const beam = new Beam(
      group.map(({ note }) => note),
      true,
    );
    Object.assign(beam.renderOptions, { minSlope: -MAX_SLOPE, maxSlope: MAX_SLOPE });
    return beam;
  });
  const voice = new Voice({ numBeats: measure.numerator, beatValue: measure.denominator }).setMode(Voice.Mode.SOFT);
  voice.addTickables(notes.map(({ note }) => note));
  new Formatter().joinVoices([voice]).formatToStave([voice], stave);
  voice.draw(context, stave);
  for (const beam of beams) beam.setContext(context).draw();
  for (const tuplet of tuplets) tuplet.setContext(context).draw();
  return notes;
}

function keyName(fifths: number): string {
  return MAJOR_KEYS[fifths + 7] ?? "C";
}

function keyOf(pitch: PartPitch): string {
  return `${pitch.letter.toLowerCase()}/${pitch.octave}`;
}

function staveNote(part: WrittenPart, entry: PartEntry, reading: Reading): StaveNote {
  const pitch = entry[reading];
  const duration = DURATIONS[entry.value] ?? "q";
  if (pitch === null) {
    const rest = new StaveNote({
      keys: [REST_PLACES[part.clef]],
      duration: `${entry.is_bar_rest ? "w" : duration}r`,
      dots: entry.dots,
      clef: part.clef,
      alignCenter: entry.is_bar_rest,
    });
    if (entry.dots > 0) Dot.buildAndAttach([rest]);
    return rest;
  }
  const note = new StaveNote({ keys: [keyOf(pitch)], duration, dots: entry.dots, clef: part.clef, autoStem: true });
  if (pitch.accidental !== null) note.addModifier(new Accidental(SIGNS[pitch.accidental]));
  for (let dot = 0; dot < entry.dots; dot++) Dot.buildAndAttach([note], { all: true });
  if (entry.is_staccato) {
    const articulation = new Articulation("a.");
    note.addModifier(articulation.setPosition(note.getStemDirection() === 1 ? 4 : 3));
  }
  if (entry.trill !== null) note.addModifier(new Ornament("tr"));
  return note;
}

function graceNotes(part: WrittenPart, entry: PartEntry, note: StaveNote, reading: Reading): readonly GraceNote[] {
  const graces = entry.graces.map((grace) => {
    const small = new GraceNote({
      keys: [keyOf(grace[reading])],
      duration: entry.graces.length > 1 ? "16" : "8",
      slash: entry.graces.length === 1,
      clef: part.clef,
    });
    const { accidental } = grace[reading];
    if (accidental !== null) small.addModifier(new Accidental(SIGNS[accidental]));
    return small;
  });
  if (graces.length > 0) {
    const group = new GraceNoteGroup(graces, true);
    note.addModifier(graces.length > 1 ? group.beamNotes() : group);
  }
  return graces;
}

function drawTies(context: SVGContext, drawn: readonly Drawn[]): void {
  drawn.forEach(({ entry, note }, at) => {
    if (at === 0 && entry.tied_from) new StaveTie({ firstNote: null, lastNote: note }).setContext(context).draw();
    if (!entry.tied_to) return;
    const next = drawn[at + 1];
    new StaveTie({ firstNote: note, lastNote: next?.note ?? null }).setContext(context).draw();
  });
}

function drawTempo(
  context: SVGContext,
  part: WrittenPart,
  system: System,
  drawn: readonly Drawn[],
  tempo: PartTempo,
): void {
  const measure = part.measures[tempo.measure];
  if (measure === undefined || !system.measures.some(({ index }) => index === tempo.measure)) return;
  const at = drawn.find(
    ({ entry }) => measure.entries.includes(entry) && entry.begin_ticks + entry.ticks > tempo.begin_ticks,
  );
  if (at === undefined) return;
  const stave = at.note.checkStave();
  const isFirst = tempo.measure === 0 && tempo.begin_ticks === 0;
  const left = isFirst ? stave.getX() + 8 : at.note.getNoteHeadBeginX();
  const y = system.top - 40 - (system.top > 66 ? 14 : 0);
  if (tempo.bpm === null) {
    label(context.svg, left, y + 16, tempo.word, "tempo word");
    return;
  }
  const compound = measure.denominator >= 8 && measure.numerator % 3 === 0;
  const halves = measure.denominator === 2;
  const quarters = compound ? 1.5 : halves ? 2 : 1;
  label(context.svg, left, y + 16, (halves ? HALF : QUARTER) + (compound ? DOT : ""), "tempo note");
  const swing = part.swing && isFirst ? " \u2003Swing" : "";
  label(context.svg, left + (compound ? 24 : 16), y + 16, `= ${Math.round(tempo.bpm / quarters)}${swing}`, "tempo");
}

/** The fingerings on one line below the system's lowest note, and what a pointer meets of each note. */
function drawFingerings(svg: SVGElement, part: WrittenPart, system: System, drawn: readonly Drawn[]): void {
  const y = system.height - 8 - (system.hasSecond ? 13 : 0);
  for (const { entry, note, graces } of drawn) {
    if (entry.note === null) continue;
    const played = part.notes[entry.note];
    const group = note.getSVGElement();
    if (played === undefined || group === undefined) continue;
    group.setAttribute("data-note", `${entry.note}`);
    const middle = (note.getNoteHeadBeginX() + note.getNoteHeadEndX()) / 2;
    const own: SVGElement[] = [];
    if (!entry.tied_from) {
      const text = fingeringText(played.valves);
      const element = centred(svg, middle, y, text, "fingering");
      own.push(element);
      if (isAlternate(played)) {
        element.classList.add("alternate");
        const half = 4 + 3.2 * text.length;
        own.push(rectangle(svg, middle - half, y - 11.5, 2 * half, 15, "ring"));
      }
      const upper = entry.trill === null ? undefined : part.notes[entry.trill];
      if (upper !== undefined) {
        own.push(centred(svg, middle, y + 13, `tr ${fingeringText(upper.valves)}`, "fingering second"));
      }
    }
    for (const [at, grace] of entry.graces.entries()) {
      const x = graces[at]?.getAbsoluteX();
      const valves = part.notes[grace.note]?.valves ?? null;
      if (x !== undefined) centred(svg, x + 4, y + 13, fingeringText(valves), "fingering second");
    }
    const target = rectangle(svg, middle - 12, 0, 24, system.height, "target");
    target.setAttribute("role", "button");
    target.setAttribute("aria-label", `${noteName(played.written_name)}, ${fingeringText(played.valves)}`);
    for (const element of [...own, target]) element.setAttribute("data-note", `${entry.note}`);
  }
}

/** Draw one or two names of one pitch on a staff of their own, for a chart. */
export function engraveChartNote(into: HTMLElement, clef: "treble" | "bass", names: readonly string[]): void {
  const holder = document.createElement("div");
  into.replaceChildren(holder);
  const pitches = names.map((name) => ({
    letter: name.charAt(0),
    octave: Number(name.replace(/^[A-G][♯♭]?/u, "")),
    accidental: name.includes("♯") ? "#" : name.includes("♭") ? "b" : null,
  }));
  const width = 124;
  const height = 128;
  const renderer = new Renderer(holder, Renderer.Backends.SVG);
  renderer.resize(width, height);
  const context = renderer.getContext();
  if (!(context instanceof SVGContext)) throw new TypeError("VexFlow draws no SVG here");
  const stave = new Stave(2, 14, width - 4).setContext(context);
  stave.addClef(clef).draw();
  const notes = pitches.map((pitch) => {
    const note = new StaveNote({ keys: [`${pitch.letter.toLowerCase()}/${pitch.octave}`], duration: "w", clef });
    if (pitch.accidental !== null) note.addModifier(new Accidental(pitch.accidental));
    return note;
  });
  const voice = new Voice({ numBeats: notes.length * 4, beatValue: 4 }).setMode(Voice.Mode.SOFT).addTickables(notes);
  new Formatter().joinVoices([voice]).formatToStave([voice], stave);
  voice.draw(context, stave);
  const places = pitches.map(staffPlace);
  const above = Math.max(0, Math.max(...places) - (clef === "treble" ? 38 : 26)) * 5;
  const svg = context.svg;
  svg.setAttribute("viewBox", `0 ${Math.min(24, 44 - above)} ${width} ${height - 18}`);
  svg.setAttribute("height", `${height - 18}`);
  svg.setAttribute("aria-hidden", "true");
  into.replaceChildren(svg);
}
