import type { Editor } from "../state/editor.svelte";
import type { MenuItem } from "../state/menu";
import type { Span } from "../state/spans";

/** The items of a menu that loop: from a place, to it, its bar, or a span; and the end of the loop. */
export function loopItems(editor: Editor, at: number, over: Span | null): MenuItem[] {
  const { view, loopGrid, loop } = editor;
  const disabled = !view.canControl;
  const offered: MenuItem[] = [
    { says: "Loop from here", disabled, run: () => void view.setLoop(loopGrid.from(at, loop)) },
    { says: "Loop to here", disabled, run: () => void view.setLoop(loopGrid.to(at, loop)) },
    over === null
      ? { says: "Loop this bar", disabled, run: () => void view.setLoop(loopGrid.bar(at)) }
      : { says: "Loop what is chosen", disabled, run: () => void view.setLoop(loopGrid.between(over.start, over.end)) },
  ];
  if (loop === null) return offered;
  return [...offered, { says: "End the loop", disabled, run: () => void view.setLoop(null) }];
}
