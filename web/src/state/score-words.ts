import type { LyricLine, Score } from "../generated/protocol";

/** A line is shown so long before it is sung, seconds. */
const LEAD_S = 4;
/** About how wide a letter of a label is, and what stands beside it, pixels. */
const LETTER = 6.4;
const BESIDE = 14;
/** Labels are no longer than this, pixels. */
export const LONGEST_LABEL = 150;
/** Words nearer than this are at one place, pixels. */
const SAME_PLACE = 4;

/** The words of one place on a timeline. */
export interface PlacedWords {
  /** Song time, seconds. */
  readonly time: number;
  /** From the left edge, pixels. */
  readonly x: number;
  /** Whether a section or a rehearsal mark begins here. */
  readonly marker: boolean;
  /** What there is room for; null where only a tick is. */
  readonly label: string | null;
  /** All that is said here. */
  readonly all: string;
}

/** How a hand is written beside a stroke, in English and in French. */
const HAND = /^[-_]*(r|l|d|g|rh|lh|right|left)[-_]*$/i;
/** A hand is written at its stroke, seconds. */
const AT_STROKE_S = 0.005;

/** A score's words without the hands that stand at strokes: those are seen at the strokes themselves. */
export function withoutHands<Word extends { readonly onset_s: number; readonly text: string }>(
  texts: readonly Word[],
  notes: readonly { readonly onset_s: number; readonly fingering: { readonly type: string } | null }[],
): Word[] {
  const strokes = notes.flatMap(({ onset_s, fingering }) => (fingering?.type === "strike" ? [onset_s] : []));
  const isAtStroke = (at: number): boolean => strokes.some((onset) => Math.abs(onset - at) <= AT_STROKE_S);
  return texts.filter(({ onset_s, text }) => !HAND.test(text.trim()) || !isAtStroke(onset_s));
}

/** The lines that are sung: those of hands at strokes are none. */
export function sungLines(
  lines: readonly LyricLine[],
  notes: Parameters<typeof withoutHands>[1],
): readonly LyricLine[] {
  return lines.filter(({ syllables }) => withoutHands(syllables, notes).length > 0);
}

/** The line that is sung, or will be within seconds; null between. */
export function lyricLineAt(lines: readonly LyricLine[], time: number): LyricLine | null {
  const following = lines.findIndex(({ start_s }) => start_s > time);
  const before = lines[(following === -1 ? lines.length : following) - 1];
  if (before !== undefined && time < before.end_s) return before;
  const next = following === -1 ? undefined : lines[following];
  return next !== undefined && next.start_s - time <= LEAD_S ? next : null;
}

/** How many syllables of a line have been begun. */
export function sungSyllables(line: LyricLine, time: number): number {
  const ahead = line.syllables.findIndex(({ onset_s }) => onset_s > time);
  return ahead === -1 ? line.syllables.length : ahead;
}

/**
 * Place a score's markers and other words over a stretch of a timeline; markers have the room first.
 *
 * @param from song time at the left edge, seconds
 * @param to song time at the right edge, seconds
 * @param width of the stretch, pixels
 */
export function placeWords(
  { markers, texts }: Pick<Score, "markers" | "texts">,
  { from, to, width }: { from: number; to: number; width: number },
): PlacedWords[] {
  const places: { time: number; x: number; marker: boolean; said: string[] }[] = [];
  const words = [
    ...markers.map((word) => ({ ...word, marker: true })),
    ...texts.map((word) => ({ ...word, marker: false })),
  ];
  for (const { onset_s, text, marker } of words.sort((a, b) => a.onset_s - b.onset_s)) {
    const x = ((onset_s - from) / Math.max(to - from, 1e-6)) * width;
    if (x < 0 || x > width) continue;
    const before = places.at(-1);
    if (before !== undefined && x - before.x < SAME_PLACE) {
      if (marker && !before.marker) before.said.unshift(text);
      else before.said.push(text);
      before.marker ||= marker;
    } else places.push({ time: onset_s, x, marker, said: [text] });
  }
  const taken: [number, number][] = [];
  const labels = new Map<number, string>();
  for (const wanted of [true, false])
    places.forEach(({ x, marker, said }, index) => {
      if (marker !== wanted) return;
      const label = said[0] ?? "";
      const end = x + Math.min(label.length * LETTER + BESIDE, LONGEST_LABEL);
      if (end > width + BESIDE || taken.some(([begin, until]) => x < until && begin < end)) return;
      taken.push([x, end]);
      labels.set(index, label);
    });
  return places.map(({ time, x, marker, said }, index) => ({
    time,
    x,
    marker,
    label: labels.get(index) ?? null,
    all: [...new Set(said)].join(" · "),
  }));
}
