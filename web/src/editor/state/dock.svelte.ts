import { remember, remembered } from "../../state/storage";

/** Where the editor stands: at the foot of the window, or aside. */
export type Dock = "foot" | "left" | "right";

/** A window that is narrower has no room beside the stage, and a lower one none for rows and values, pixels. */
const LEAST_WINDOW = { width: 960, height: 600 };
const LEAST_HEIGHT = 210;
const LEAST_WIDTH = 400;
/** What is left to the stage at least, pixels. */
const STAGE = 440;
const USUAL_HEIGHT = 400;

/** Where the editor stands and how large it is, as the person likes it. */
export class DockPlace {
  #wanted = $state<Dock>(remembered().editorDock);
  #height = $state(remembered().editorHeight);
  #width = $state(remembered().editorWidth);
  /** Size of the window, and the height that there is at its foot at most, pixels. */
  window = $state.raw({ width: 0, height: 0, room: 0, narrow: false });

  /** Whether there is a choice. */
  get movable(): boolean {
    // The room at the foot is no measure: it depends on the transport, and that on where the editor stands.
    const { width, height } = this.window;
    return width >= LEAST_WINDOW.width && height >= LEAST_WINDOW.height;
  }

  get dock(): Dock {
    return this.movable ? this.#wanted : "foot";
  }

  set dock(dock: Dock) {
    this.#wanted = dock;
    remember({ editorDock: dock });
  }

  get aside(): boolean {
    return this.dock !== "foot";
  }

  /** Height at the foot, width aside: pixels, least and most. */
  get bounds(): { least: number; most: number } {
    const { width, room } = this.window;
    if (this.aside) return { least: LEAST_WIDTH, most: Math.max(Math.round(width - STAGE), LEAST_WIDTH) };
    return { least: LEAST_HEIGHT, most: Math.max(Math.round(room), LEAST_HEIGHT) };
  }

  get size(): number {
    const { width, room, narrow } = this.window;
    const { least, most } = this.bounds;
    const wanted = this.aside ? this.#width : this.#height;
    const foot = narrow ? room * 0.8 : Math.min(room * 0.67, USUAL_HEIGHT);
    const usual = this.aside ? width * 0.36 : foot;
    return Math.round(Math.min(Math.max(wanted > 0 ? wanted : usual, least), most));
  }

  /** @param pixels that it is to have; 0 for what suits the window. */
  resize(pixels: number): void {
    if (this.aside) this.#width = pixels;
    else this.#height = pixels;
  }

  /** Keep the size for the next visit. */
  keep(): void {
    const size = (this.aside ? this.#width : this.#height) === 0 ? 0 : this.size;
    remember(this.aside ? { editorWidth: size } : { editorHeight: size });
  }
}
