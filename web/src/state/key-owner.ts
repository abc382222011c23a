/** What of an element says whether it needs a key press itself. */
export interface KeyTarget {
  /** In small letters: `input`, `select`. */
  readonly tag: string;
  /** Of an input. */
  readonly type: string;
  readonly editable: boolean;
  /** It is something that Enter and Space press, or stands in it. */
  readonly pressable: boolean;
  /** Its list is open. */
  readonly open: boolean;
}

const ARROWS = ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight"];
const ALONG = [...ARROWS, "Home", "End", "PageUp", "PageDown"];

/** Keys that an input of a type takes when the keyboard has come to it; what is not named here is typed into. */
const INPUT_KEYS: Readonly<Record<string, readonly string[]>> = {
  range: ALONG,
  checkbox: [" "],
  radio: [" ", ...ARROWS],
  button: [" ", "Enter"],
  submit: [" ", "Enter"],
  file: [" ", "Enter"],
};

/**
 * Whether a key press is for the element that has the focus, and not for the page.
 *
 * @param byPointer a pointer has put the focus there: then only what is typed into, and an open list, keep their keys
 */
export function ownsKey(target: KeyTarget, key: string, byPointer: boolean): boolean {
  if (target.editable || target.tag === "textarea") return true;
  if (target.tag === "select") return target.open || !byPointer;
  if (target.tag === "input") {
    const keys = INPUT_KEYS[target.type];
    return keys === undefined || (!byPointer && keys.includes(key));
  }
  return !byPointer && target.pressable && (key === "Enter" || key === " ");
}

/** What there is to know of an event's target; null where it is no element. */
export function keyTargetOf(target: EventTarget | null): KeyTarget | null {
  if (!(target instanceof HTMLElement)) return null;
  return {
    tag: target.tagName.toLowerCase(),
    type: target instanceof HTMLInputElement ? target.type : "",
    editable: target.isContentEditable,
    pressable: target.closest("button, a, summary, label") !== null,
    open: target instanceof HTMLSelectElement && isOpen(target),
  };
}

function isOpen(select: HTMLSelectElement): boolean {
  try {
    return select.matches(":open");
  } catch {
    // A browser that cannot tell: its list may be open.
    return true;
  }
}
