/** What a film's file is called. */

/** Characters that a file's name cannot have on one system or another, and those that are not seen. */
const FORBIDDEN = /[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2066-\u2069\ufeff<>:"/\\|?*]+/gu;
/** Names that Windows keeps for devices. */
const RESERVED = /^(con|prn|aux|nul|com\d|lpt\d)$/i;
/** Most systems take 255 bytes; of letters outside of ASCII each may be four. */
const LONGEST = 60;

/** A piece's title as a file's name, with an ending: `Ode to Joy.mp4`. */
export function fileName(title: string, ending: string): string {
  const plain = title.normalize("NFC").replace(FORBIDDEN, " ").replace(/\s+/gu, " ").trim();
  const cut = Array.from(plain)
    .slice(0, LONGEST)
    .join("")
    .replace(/[. ]+$/u, "")
    .replace(/^[. ]+/u, "");
  const name = cut === "" ? "Reina" : RESERVED.test(cut) ? `${cut} film` : cut;
  return `${name}.${ending}`;
}
