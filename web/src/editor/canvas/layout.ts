/** Heights of the timeline's parts, CSS pixels. */
export interface Layout {
  /** Upper part of the ruler: bar numbers, along which loops are drawn. */
  readonly loop: number;
  /** Bars and times. */
  readonly ruler: number;
  /** Flags of the markers. */
  readonly markers: number;
  /** Waveform and notes. */
  readonly music: number;
  /** The chosen keyframes' span, with a grip at either end. */
  readonly span: number;
  readonly row: number;
}

export const WIDE: Layout = { loop: 15, ruler: 34, markers: 18, music: 46, span: 12, row: 26 };
export const NARROW: Layout = { loop: 18, ruler: 36, markers: 16, music: 30, span: 16, row: 34 };

/** Height of what stands above the rows. */
export function headHeight({ ruler, markers, music, span }: Layout): number {
  return ruler + markers + music + span;
}

/** Half the width of a keyframe's diamond. */
export const DIAMOND = 5;
