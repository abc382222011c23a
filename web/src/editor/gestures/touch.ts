/** A finger that rests so long asks for a menu, or begins a box. */
export const LONG_PRESS_MS = 420;

/** Whether an event is a finger's. Browsers that do not tell of a click or a menu whose it is have a mouse. */
export function isTouch(event: MouseEvent): boolean {
  return "pointerType" in event && event.pointerType === "touch";
}
