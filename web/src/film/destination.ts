/** Where a film is written to: a file on the disk where the browser can, else a blob that is downloaded. */

/** Bytes at a place of the file, as mediabunny's StreamTarget hands them on. */
export interface Chunk {
  readonly data: Uint8Array<ArrayBuffer>;
  readonly position: number;
}

export interface Destination {
  write(chunk: Chunk): Promise<void>;
  /** All is written. Returns the film where it is to be downloaded. */
  finish(): Promise<Blob | null>;
  /** Leave nothing behind. */
  discard(): Promise<void>;
}

/** A file that a person chose; it takes its content when all is written. */
export async function fileDestination(file: RemovableFile): Promise<Destination> {
  const stream = await file.createWritable();
  return {
    write: ({ data, position }) => stream.write({ type: "write", data, position }),
    finish: async () => {
      await stream.close();
      return null;
    },
    discard: async () => {
      await stream.abort();
      // The picker made it, empty; not every browser can take it away again.
      await file.remove?.();
    },
  };
}

/** A file that the browser's picker made. */
export interface RemovableFile extends FileSystemFileHandle {
  remove?(): Promise<void>;
}

/** A blob, which browsers keep on the disk once it is large. */
export function blobDestination(type: string): Destination {
  let pieces: Blob[] = [];
  let length = 0;
  /** What was written again over what stood there: the file's head, at the end. */
  let patches: Chunk[] = [];
  return {
    write: ({ data, position }) => {
      if (position > length) return Promise.reject(new RangeError(`Nothing is written yet before byte ${position}`));
      const over = Math.min(length - position, data.byteLength);
      if (over > 0) patches.push({ data: data.slice(0, over), position });
      if (over < data.byteLength) pieces.push(new Blob([data.subarray(over)]));
      length += data.byteLength - over;
      return Promise.resolve();
    },
    finish: () => {
      let film = new Blob(pieces, { type });
      for (const { data, position } of patches) {
        const rest = film.slice(position + data.byteLength);
        film = new Blob([film.slice(0, position), data, rest], { type });
      }
      pieces = [];
      patches = [];
      return Promise.resolve(film);
    },
    discard: () => {
      pieces = [];
      patches = [];
      return Promise.resolve();
    },
  };
}

interface FilePicker {
  showSaveFilePicker?(options: {
    suggestedName: string;
    types: { accept: Record<string, string[]> }[];
  }): Promise<RemovableFile>;
}

/**
 * Ask where to write a film, if the browser can write files; to be called from a click or a key.
 *
 * @returns null when the person thought better of it.
 */
export async function chooseDestination(name: string, type: string): Promise<Destination | null> {
  const picker = (globalThis as FilePicker).showSaveFilePicker?.bind(globalThis);
  if (picker === undefined) return blobDestination(type);
  const ending = `.${name.split(".").at(-1) ?? ""}`;
  try {
    return await fileDestination(await picker({ suggestedName: name, types: [{ accept: { [type]: [ending] } }] }));
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") return null;
    throw error;
  }
}

/** Hand a blob to the browser's downloads. */
export function download(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // The browser has begun to read it by then.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
