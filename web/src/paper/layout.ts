import type { PartEntry, PartMeasure, WrittenPart } from "../generated/protocol";
import { drumsDepth, drumsHeight, isInVoices, voicesWidth } from "./drum-layout";
import { SPACE, STEM, staffPlace } from "./staff";

/** Which of the two ways a part is read. */
export type Reading = "written" | "sounding";

/** A measure and how wide it is, in the staff's own units (a staff's space is 10). */
export interface Placed {
  /** Index into the part's measures. */
  readonly index: number;
  readonly width: number;
  /** A signature or a metre is printed at its beginning; at the beginning of a system both are, where they hold. */
  readonly showsKey: boolean;
  readonly showsMetre: boolean;
}

/** One line of the page. */
export interface System {
  readonly measures: readonly Placed[];
  readonly beginS: number;
  readonly endS: number;
  /** Where the staff's top line lies, and how high the whole system is. */
  readonly top: number;
  readonly height: number;
  /** Whether it is as wide as the page; the last one may be shorter. */
  readonly full: boolean;
  /** Whether there is a second line of fingerings: of trills and grace notes; of drums, the left hand's. */
  readonly hasSecond: boolean;
}

/** Left of the staff, for bar numbers. */
export const INDENT = 8;

const STAFF = 4 * SPACE;
const CLEF = 42;
const SHARP = 11;
const METRE = 30;
const MARGIN = 24;
const REST_BARS = 110;
const SHORTEST_MEASURE = 56;
/** Above the staff: bar numbers; with a tempo above them. */
const HEAD = 26;
const TEMPO = 24;
/** Below the lowest note: the fingering, and of a trill a second one. */
const FINGERING = 30;
const SECOND_FINGERING = 13;
/** A last line that is filled less than this is left as it is. */
const NEARLY_FULL = 0.72;

/** The staff's top and bottom lines as letters counted from C0. */
const TREBLE = { top: 5 * 7 + 3, bottom: 4 * 7 + 2 };
const STAVES = { treble: TREBLE, percussion: TREBLE, bass: { top: 3 * 7 + 5, bottom: 2 * 7 + 4 } };

/** Fifths of the signature as a part is read. */
export function fifthsOf(measure: PartMeasure, reading: Reading): number {
  return reading === "written" ? measure.written_fifths : measure.fifths;
}

/** How much room a note or rest needs to be read, with its fingering below it. */
function entryWidth(entry: PartEntry, reading: Reading): number {
  const pitch = reading === "written" ? entry.written : entry.sounding;
  const accidental = (pitch?.accidental ?? null) === null ? 0 : 10;
  const time = 12 + 8.5 * Math.log2(1 + entry.ticks / 3);
  return Math.max(time, entry.note === null ? 18 : 27) + accidental + 6 * entry.dots + 13 * entry.graces.length;
}

function measureWidth(measure: PartMeasure, reading: Reading): number {
  if (measure.bars > 1) return REST_BARS;
  if (isInVoices(measure)) return Math.max(MARGIN + voicesWidth(measure), SHORTEST_MEASURE);
  const entries = measure.entries.reduce((sum, entry) => sum + entryWidth(entry, reading), 0);
  return Math.max(MARGIN + entries, SHORTEST_MEASURE);
}

function signatureWidth(fifths: number, before: number): number {
  return SHARP * Math.max(Math.abs(fifths), fifths === 0 ? Math.abs(before) : 0) + (fifths === 0 ? 0 : 8);
}

/**
 * A part broken into lines, each measure with its share of the line.
 *
 * @param width of the page, in the staff's units.
 */
export function layOut(part: WrittenPart, reading: Reading, width: number): readonly System[] {
  const systems: System[] = [];
  let line: Placed[] = [];
  let used = 0;
  part.measures.forEach((measure, index) => {
    const before = part.measures[index - 1];
    const fifths = fifthsOf(measure, reading);
    const fifthsBefore = before === undefined ? fifths : fifthsOf(before, reading);
    const showsKey = fifthsBefore !== fifths;
    const showsMetre = before?.numerator !== measure.numerator || before.denominator !== measure.denominator;
    const own = measureWidth(measure, reading) + (showsMetre ? METRE : 0);
    const begin = CLEF + signatureWidth(fifths, 0);
    const change = showsKey ? signatureWidth(fifths, fifthsBefore) : 0;
    if (line.length > 0 && used + own + change > width - INDENT) {
      systems.push(system(part, reading, line, used, width, false));
      line = [];
      used = 0;
    }
    const placed = { index, width: own + (line.length === 0 ? begin : change), showsKey, showsMetre };
    line.push(placed);
    used += placed.width;
  });
  if (line.length > 0) systems.push(system(part, reading, line, used, width, true));
  return systems;
}

/** How far the notes of a measure, their stems, beams and dots reach below the staff. */
function depth(measure: PartMeasure, reading: Reading, staff: { top: number; bottom: number }): number {
  const middle = (staff.top + staff.bottom) / 2;
  let lowest = 0;
  for (const entry of measure.entries) {
    const pitch = entry[reading];
    if (pitch === null) continue;
    const group = entry.beam === null ? [entry] : measure.entries.filter(({ beam }) => beam === entry.beam);
    const places = group.flatMap((one) => (one[reading] === null ? [] : [staffPlace(one[reading])]));
    const mean = places.reduce((sum, place) => sum + place, 0) / places.length;
    const stemDown = entry.value > 1 && mean >= middle;
    const head = (staff.bottom - (stemDown ? Math.min(...places) : staffPlace(pitch))) * (SPACE / 2);
    const beam = stemDown && group.length > 1 ? SPACE * 0.6 : 0;
    lowest = Math.max(lowest, head + (stemDown ? STEM + beam : entry.is_staccato ? SPACE : 0));
  }
  return lowest;
}

function system(
  part: WrittenPart,
  reading: Reading,
  line: readonly Placed[],
  used: number,
  width: number,
  last: boolean,
): System {
  const full = !last || used >= NEARLY_FULL * width;
  const spare = full ? (width - INDENT) / used : Math.min(1, (width - INDENT) / used);
  const measures = line.map((placed) => ({ ...placed, width: placed.width * spare }));
  const shown = line.map(({ index }) => part.measures[index]).filter((measure) => measure !== undefined);
  const entries = shown.flatMap((measure) => measure.entries);
  const places = entries.flatMap(({ written, sounding, graces }) =>
    [reading === "written" ? written : sounding, ...graces.map((grace) => grace[reading])].flatMap((pitch) =>
      pitch === null ? [] : [staffPlace(pitch)],
    ),
  );
  const staff = STAVES[part.clef];
  const drums = part.clef === "percussion";
  const above = drums ? drumsHeight(entries, staff) : (Math.max(...places, staff.top) - staff.top) * (SPACE / 2);
  const below = drums
    ? drumsDepth(entries, staff)
    : Math.max(...shown.map((measure) => depth(measure, reading, staff)));
  const hasTempo = part.tempi.some(({ measure }) => line.some(({ index }) => index === measure));
  const hasTrill = entries.some(({ trill }) => trill !== null);
  const hasSecond = drums || hasTrill || entries.some(({ graces }) => graces.length > 0);
  const top = HEAD + Math.max(above, hasTrill ? 20 : 0) + (hasTempo ? TEMPO : 0);
  const height = top + STAFF + below + FINGERING + (hasSecond ? SECOND_FINGERING : 0);
  return {
    measures,
    beginS: shown[0]?.begin_s ?? 0,
    endS: shown.at(-1)?.end_s ?? 0,
    top,
    height,
    full,
    hasSecond,
  };
}

/** The system that a song time, seconds, falls into; before the first it is the first, after the last the last. */
export function systemAt(systems: readonly Pick<System, "beginS">[], songTime: number): number {
  let found = 0;
  systems.forEach(({ beginS }, index) => {
    if (beginS <= songTime + 1e-6) found = index;
  });
  return found;
}
