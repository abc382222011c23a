import { remember, remembered } from "./storage";

/** The panels, and where each stands; every place has room for one, and a narrow window for one in all. */
const PLACES = {
  piece: "left",
  pieces: "left",
  paper: "left",
  views: "right",
  film: "right",
  practice: "right",
  show: "foot",
  inTime: "foot",
} as const;

export type Panel = keyof typeof PLACES;

const PANELS = Object.keys(PLACES) as Panel[];

/** Places in the piece's panel that one may be led to. */
export type PiecePlace = "cast" | "part" | "findings";

/** Which panels are open. */
export class Panels {
  /** The window has room for one panel at a time. */
  narrow = $state(false);
  /** Where in the piece's panel to go; null once there. */
  sought = $state<PiecePlace | null>(null);
  #open = $state.raw<readonly Panel[]>(PANELS.filter((panel) => remembered().panels.includes(panel)));

  isOpen(panel: Panel): boolean {
    return this.#open.includes(panel);
  }

  /** Whether a panel of the sides covers a narrow window's stage. */
  get coversStage(): boolean {
    return this.narrow && this.#open.some((panel) => PLACES[panel] !== "foot");
  }

  toggle(panel: Panel, open = !this.isOpen(panel)): void {
    const others = this.#open.filter((other) => other !== panel);
    if (!open) this.#set(others);
    else if (this.narrow) this.#set([panel]);
    else this.#set([...others.filter((other) => PLACES[other] !== PLACES[panel]), panel]);
  }

  /** Close the panel that was opened last; returns whether there was one. */
  closeLast(): boolean {
    const last = this.#open.at(-1);
    if (last === undefined) return false;
    this.toggle(last, false);
    return true;
  }

  #set(open: readonly Panel[]): void {
    this.#open = open;
    // The lists of pieces and views and a film are asked for each time; what one works in stays.
    remember({ panels: open.filter((panel) => ["piece", "show", "practice"].includes(panel)) });
  }
}
