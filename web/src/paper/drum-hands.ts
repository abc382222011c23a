import type { PartHead, WrittenPart } from "../generated/protocol";
import { serverWords } from "../words";
import type { Drawn } from "./engraved";
import type { System } from "./layout";
import { centred, rectangle } from "./lettering";

const ROW = 13;

/**
 * The hands on two lines below a system of a drum part, the right hand's above the left's, and what a pointer meets
 * of each note.
 */
export function drawHands(svg: SVGElement, part: WrittenPart, system: System, drawn: readonly Drawn[]): void {
  const rows = { R: system.height - 8 - ROW, L: system.height - 8 };
  for (const { entry, note, graces } of drawn) {
    if (entry.note === null) continue;
    const group = note.getSVGElement();
    if (group === undefined) continue;
    group.setAttribute("data-note", `${entry.note}`);
    const middle = (note.getNoteHeadBeginX() + note.getNoteHeadEndX()) / 2;
    const own: SVGElement[] = [];
    for (const { hand } of entry.heads) {
      if (hand !== null) own.push(centred(svg, middle, rows[hand], hand, "fingering hand"));
    }
    for (const [at, { head }] of entry.graces.entries()) {
      const x = graces[at]?.getAbsoluteX();
      if (head?.hand && x !== undefined) {
        own.push(centred(svg, x + 3, rows[head.hand], head.hand.toLowerCase(), "fingering second"));
      }
    }
    const target = rectangle(svg, middle - 12, 0, 24, system.height, "target");
    target.setAttribute("role", "button");
    target.setAttribute("aria-label", entry.heads.map((head) => spoken(part, head)).join(", "));
    for (const element of [...own, target]) element.setAttribute("data-note", `${entry.note}`);
  }
}

/** A hit in words: what is struck, and with what. */
function spoken(part: WrittenPart, head: PartHead): string {
  const note = part.notes[head.note];
  if (note === undefined) return "";
  const piece = serverWords("piece", note.piece ?? "", note.written_name);
  return note.limb === null ? piece : `${piece} (${serverWords("limb", note.limb, note.limb.replace("_", " "))})`;
}
