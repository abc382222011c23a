/**
 * A small picture of each session that was seen, kept in the browser: index.html shows it at once when the session is
 * opened again, and the list of pieces shows it beside the name.
 */

import { pageStorage } from "./storage";

/** index.html reads by it. */
const KEY = "reina.picture.";
const WIDTH = 640;
const QUALITY = 0.6;
/** Some 20 kB each; a browser keeps 5 MB of a page. */
const MAX_PICTURES = 60;

/** A session's picture as a data URL; null where there is none. */
export function pictureOf(session: string): string | null {
  return pageStorage()?.getItem(KEY + session) ?? null;
}

/**
 * Keep what a canvas shows as a session's picture.
 *
 * To be called in the task in which the canvas was drawn: a WebGL canvas forgets its picture after it.
 */
export function keepPicture(session: string, canvas: HTMLCanvasElement): void {
  const storage = pageStorage();
  const small = document.createElement("canvas");
  small.width = WIDTH;
  small.height = Math.max(Math.round((WIDTH * canvas.height) / Math.max(canvas.width, 1)), 1);
  const picture = small.getContext("2d");
  if (storage === null || picture === null) return;
  picture.drawImage(canvas, 0, 0, small.width, small.height);
  try {
    const kept = Object.keys(storage).filter((key) => key.startsWith(KEY) && key !== KEY + session);
    for (const key of kept.slice(0, Math.max(0, kept.length + 1 - MAX_PICTURES))) storage.removeItem(key);
    storage.setItem(KEY + session, small.toDataURL("image/jpeg", QUALITY));
  } catch {
    // Storage is full or forbidden: the next visit begins without a picture.
  }
}

/** Forget the picture of a session that is no more. */
export function forgetPicture(session: string): void {
  pageStorage()?.removeItem(KEY + session);
}

/** Take the picture away that index.html shows, once the stage is seen. */
export function removePoster(): void {
  document.getElementById("poster")?.remove();
}
