import { language } from "./language";

/** Of a pitch, its letter, its accidental and its octave (C4 is the middle C): `B♭4`. */
const PITCH = /^([A-G])([♯♭]?)(-?\d+)$/u;
const KEY = /^([A-G])([♯♭]?) (major|minor)$/u;

/** What German players call a letter with its accidental: B is H, B♭ is B. */
const GERMAN: Readonly<Record<string, string>> = { B: "H", "B♭": "B", "E♭": "Es", "A♭": "As" };
const GERMAN_ENDINGS: Readonly<Record<string, string>> = { "": "", "♯": "is", "♭": "es" };
/** Signs of the octaves from the small one up, and from the great one down. */
const ABOVE = ["", "′", "″", "‴", "⁗"];
const BELOW = ["", "₁", "₂"];
/** What Japanese players read a letter as, and what it is in the name of a key. */
const SYLLABLES: Readonly<Record<string, string>> = { C: "ド", D: "レ", E: "ミ", F: "ファ", G: "ソ", A: "ラ", B: "シ" };
const IROHA: Readonly<Record<string, string>> = { C: "ハ", D: "ニ", E: "ホ", F: "ヘ", G: "ト", A: "イ", B: "ロ" };
const IROHA_SIGNS: Readonly<Record<string, string>> = { "": "", "♯": "嬰", "♭": "変" };

/**
 * A note's name as players say it in the language that is shown: `B♭4` is b′ in German, and シ♭4 in Japanese.
 *
 * German tells octaves as Helmholtz did: c′ is the middle C, c the one below, C the one below that.
 *
 * @param name as the server spells it; anything else is given back as it is
 */
export function noteName(name: string): string {
  const [, letter, sign = "", octave] = PITCH.exec(name) ?? [];
  if (letter === undefined) return name;
  if (language() === "de") return inGermanOctave(inGerman(letter, sign), Number(octave));
  return language() === "ja" ? `${SYLLABLES[letter] ?? letter}${sign}${octave}` : name;
}

/**
 * A key's name: `E♭ major` is Es-Dur in German, and 変ホ長調 in Japanese.
 *
 * @param name as the server says it; anything else is given back as it is
 */
export function keyName(name: string): string {
  const [, letter, sign = "", mode] = KEY.exec(name) ?? [];
  if (letter === undefined) return name;
  if (language() === "de") {
    const tonic = inGerman(letter, sign);
    return mode === "major" ? `${tonic}-Dur` : `${tonic.toLowerCase()}-Moll`;
  }
  if (language() === "ja")
    return `${IROHA_SIGNS[sign] ?? ""}${IROHA[letter] ?? letter}${mode === "major" ? "長調" : "短調"}`;
  return name;
}

function inGerman(letter: string, sign: string): string {
  return GERMAN[letter + sign] ?? (GERMAN[letter] ?? letter) + (GERMAN_ENDINGS[sign] ?? "");
}

function inGermanOctave(name: string, octave: number): string {
  return octave >= 3
    ? name.toLowerCase() + (ABOVE[octave - 3] ?? `${octave}`)
    : name + (BELOW[2 - octave] ?? `${octave}`);
}
