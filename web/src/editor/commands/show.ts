import type { Editor } from "../state/editor.svelte";

/** Give the show another title. */
export function setTitle(editor: Editor, title: string): void {
  const { document } = editor.store;
  if (document === null || document.title === title) return;
  editor.edit("Title changed", [{ edit: "change_show", changes: { title } }]);
}
