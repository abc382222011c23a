import type { Editor } from "../state/editor.svelte";
import type { MenuItem } from "../state/menu";
import type { Span } from "../state/spans";
import { does } from "../../words/editor-does/en";

/** The items of a menu that loop: from a place, to it, its bar, or a span; and the end of the loop. */
export function loopItems(editor: Editor, at: number, over: Span | null): MenuItem[] {
  const { view, loopGrid, loop } = editor;
  const disabled = !view.canControl;
  const offered: MenuItem[] = [
    { says: does.loopFrom, disabled, run: () => void view.setLoop(loopGrid.from(at, loop)) },
    { says: does.loopTo, disabled, run: () => void view.setLoop(loopGrid.to(at, loop)) },
    over === null
      ? { says: does.loopBar, disabled, run: () => void view.setLoop(loopGrid.bar(at)) }
      : { says: does.loopChosen, disabled, run: () => void view.setLoop(loopGrid.between(over.start, over.end)) },
  ];
  if (loop === null) return offered;
  return [...offered, { says: does.endLoop, disabled, run: () => void view.setLoop(null) }];
}
