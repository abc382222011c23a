/**
 * Whether the keyboard's focus stands where a pointer has put it.
 *
 * Who clicks a button means the click: the keys stay the page's. Who comes to it with Tab means the button. A focus that
 * a script moves (into a menu that opens) is as if the keyboard had moved it.
 */
export class FocusOrigin {
  #pressed = false;
  #byPointer = false;

  /** @param page whose events are listened to, before anything below it hears them */
  constructor(page: Pick<Window, "addEventListener">) {
    const early = { capture: true };
    // After a touch the focus moves with the mouse's events that follow the pointer's.
    for (const type of ["pointerdown", "mousedown"] as const) {
      page.addEventListener(type, () => (this.#pressed = this.#byPointer = true), early);
    }
    for (const type of ["pointerup", "pointercancel", "mouseup"] as const) {
      page.addEventListener(type, () => (this.#pressed = false), early);
    }
    page.addEventListener("focusin", () => (this.#byPointer = this.#pressed), early);
  }

  get byPointer(): boolean {
    return this.#byPointer;
  }
}
