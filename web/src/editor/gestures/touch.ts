/** Whether an event is a finger's. Browsers that do not tell of a click or a menu whose it is have a mouse. */
export function isTouch(event: MouseEvent): boolean {
  return "pointerType" in event && event.pointerType === "touch";
}
