const KEY = "reinaPosters";
const WIDTH = 640;
const QUALITY = 0.6;
/** Some 20 kB each. */
const MOST_KEPT = 8;

/**
 * Keep a small picture of a session, which index.html shows at once when this browser comes again.
 *
 * To be called in the task in which the canvas was drawn: a WebGL canvas forgets its picture after it.
 */
export function keepPoster(session: string, canvas: HTMLCanvasElement): void {
  const small = document.createElement("canvas");
  small.width = WIDTH;
  small.height = Math.max(Math.round((WIDTH * canvas.height) / Math.max(canvas.width, 1)), 1);
  const picture = small.getContext("2d");
  if (picture === null) return;
  picture.drawImage(canvas, 0, 0, small.width, small.height);
  try {
    const kept = new Map(Object.entries(readPosters()).filter(([id]) => id !== session));
    kept.set(session, small.toDataURL("image/jpeg", QUALITY));
    localStorage.setItem(KEY, JSON.stringify(Object.fromEntries([...kept].slice(-MOST_KEPT))));
  } catch {
    // Storage is full or forbidden: the next visit begins without a picture.
  }
}

/** Take the poster away, once the stage is seen. */
export function removePoster(): void {
  document.getElementById("poster")?.remove();
}

function readPosters(): Record<string, string> {
  const kept: unknown = JSON.parse(localStorage.getItem(KEY) ?? "{}");
  return typeof kept === "object" && kept !== null ? (kept as Record<string, string>) : {};
}
