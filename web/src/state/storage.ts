import type { Language } from "../words/language";

export type NoteNames = "written" | "sounding";
export type Paper = "A4" | "letter";
export type Quality = "automatic" | "full" | "medium" | "low";

/** A session that this browser made, as the list of pieces names it. */
export interface KeptPiece {
  readonly title: string;
  /** When it was opened last, milliseconds since 1970. */
  readonly opened: number;
}

/** What this browser remembers: the sessions that it may change, and how the person likes the page. */
export interface Remembered {
  /** Session id to the token that changes it. */
  readonly tokens: Readonly<Record<string, string>>;
  /** What is known of the sessions among them that were opened here. */
  readonly pieces: Readonly<Record<string, KeptPiece>>;
  /** The session that `/` opens. */
  readonly home: string | null;
  readonly volume: number;
  readonly muted: boolean;
  /** By how much sound comes late on a device beyond what the browser knows, milliseconds; "" for any device. */
  readonly latencies: Readonly<Record<string, number>>;
  /** How loud the metronome and the tones of notes are, 0…1. */
  readonly clickVolume: number;
  /** Panels that are open. */
  readonly panels: readonly string[];
  /** Height of the show's editor, pixels; 0 for what suits the window. */
  readonly editorHeight: number;
  /** Where the show's editor stands, and its width at a side, pixels; 0 for what suits the window. */
  readonly editorDock: "foot" | "left" | "right";
  readonly editorWidth: number;
  /** Groups of tracks that are folded up. */
  readonly closedGroups: readonly string[];
  /** Whether keyframes are drawn to places, and to which. */
  readonly snapping: boolean;
  readonly snaps: readonly ("bars" | "beats" | "keys" | "markers" | "frames")[];
  /** Whether curves of different units each fill the room. */
  readonly normalised: boolean;
  /** Notes are called as written for the trumpet, or as they sound. */
  readonly noteNames: NoteNames;
  /** What parts are printed on; null for what is usual where the person is. */
  readonly paper: Paper | null;
  /** How much the stage draws; "automatic" lets the page measure. */
  readonly quality: Quality;
  /** Whether the valves, or a drummer's feet, are seen in a picture of their own. */
  readonly valvesInset: boolean;
  /** The page's language, where it was chosen by hand; null for the browser's. */
  readonly language: Language | null;
  /** Somebody has pressed Play here before: the welcome has done its work. */
  readonly hasPlayed: boolean;
}

const KEY = "reina";
const MAX_TOKENS = 200;

const NOTHING: Remembered = {
  tokens: {},
  pieces: {},
  home: null,
  volume: 0.9,
  muted: false,
  latencies: {},
  clickVolume: 0.8,
  panels: [],
  editorHeight: 0,
  editorDock: "foot",
  editorWidth: 0,
  closedGroups: [],
  snapping: true,
  snaps: ["bars", "beats", "keys", "markers"],
  normalised: true,
  noteNames: "written",
  paper: null,
  quality: "automatic",
  valvesInset: false,
  language: null,
  hasPlayed: false,
};

/** What is remembered; defaults where the browser keeps nothing or lets nothing be read. */
export function remembered(storage: Pick<Storage, "getItem"> | null = pageStorage()): Remembered {
  try {
    const text = storage?.getItem(KEY) ?? null;
    return text === null ? NOTHING : { ...NOTHING, ...(JSON.parse(text) as Partial<Remembered>) };
  } catch {
    return NOTHING;
  }
}

/** Remember a change; without a storage (private windows) it is forgotten with the page. */
export function remember(
  change: Partial<Remembered>,
  storage: Pick<Storage, "getItem" | "setItem"> | null = pageStorage(),
): void {
  const next = { ...remembered(storage), ...change };
  const tokens = Object.fromEntries(Object.entries(next.tokens).slice(-MAX_TOKENS));
  try {
    storage?.setItem(KEY, JSON.stringify({ ...next, tokens }));
  } catch {
    // Full or forbidden: the page works on, it only starts afresh next time.
  }
}

/** Remember the token of a session that this browser made. */
export function rememberToken(id: string, token: string): void {
  remember({ tokens: { ...remembered().tokens, [id]: token } });
}

/** What the browser keeps for the page; null where it keeps nothing. */
export function pageStorage(): Storage | null {
  try {
    return localStorage;
  } catch {
    return null;
  }
}
