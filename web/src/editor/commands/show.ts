import type { Editor } from "../state/editor.svelte";
import { does } from "../../words/editor-does/en";

/** Give the show another title. */
export function setTitle(editor: Editor, title: string): void {
  const { document } = editor.store;
  if (document === null || document.title === title) return;
  editor.edit(does.titleChanged, [{ edit: "change_show", changes: { title } }]);
}
