/** How long an audio file lasts, seconds; null where the browser cannot tell. */
export function audioLength(file: File): Promise<number | null> {
  const address = URL.createObjectURL(file);
  const audio = new Audio();
  return new Promise<number | null>((resolve) => {
    audio.preload = "metadata";
    audio.onloadedmetadata = () => resolve(Number.isFinite(audio.duration) ? audio.duration : null);
    audio.onerror = () => resolve(null);
    audio.src = address;
  }).finally(() => URL.revokeObjectURL(address));
}
