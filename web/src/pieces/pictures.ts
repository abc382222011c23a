/** Small pictures of pieces, kept in the browser: they are nobody else's business. */

const KEY = "reina.picture.";
const WIDTH = 240;
const HEIGHT = 135;
const QUALITY = 0.72;
/** Pictures that are kept; each has some 8 kB, and a browser keeps 5 MB of a page. */
const MAX_PICTURES = 100;

/** A piece's picture as a data URL; null where there is none. */
export function pictureOf(id: string, storage: Storage | null = pageStorage()): string | null {
  return storage?.getItem(KEY + id) ?? null;
}

/** How much of what has no room is cut off above, of 1: heads are above the middle. */
const CUT_ABOVE = 0.35;

/** Keep the middle of what a canvas shows as a piece's picture; called while its picture is still drawn. */
export function takePicture(id: string, canvas: HTMLCanvasElement, storage: Storage | null = pageStorage()): void {
  if (storage === null || canvas.width === 0 || canvas.height === 0) return;
  const small = document.createElement("canvas");
  small.width = WIDTH;
  small.height = HEIGHT;
  const scale = Math.max(WIDTH / canvas.width, HEIGHT / canvas.height);
  const [width, height] = [canvas.width * scale, canvas.height * scale];
  small.getContext("2d")?.drawImage(canvas, (WIDTH - width) / 2, (HEIGHT - height) * CUT_ABOVE, width, height);
  try {
    storage.setItem(KEY + id, small.toDataURL("image/jpeg", QUALITY));
    for (const old of keptIds(storage).slice(0, -MAX_PICTURES)) if (old !== id) forgetPicture(old, storage);
  } catch {
    // The storage is full: the piece stands in the list without a picture.
  }
}

/** Forget a piece's picture. */
export function forgetPicture(id: string, storage: Storage | null = pageStorage()): void {
  storage?.removeItem(KEY + id);
}

function keptIds(storage: Storage): string[] {
  return Array.from({ length: storage.length }, (_, index) => storage.key(index) ?? "")
    .filter((key) => key.startsWith(KEY))
    .map((key) => key.slice(KEY.length));
}

function pageStorage(): Storage | null {
  try {
    return localStorage;
  } catch {
    return null;
  }
}
