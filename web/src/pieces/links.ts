/** Addresses of a session, for others. */

const CONTROL = /(?:^#|&)control=([\w-]+)/;

/** Where a session is watched. */
export function watchLink(id: string, origin: string): string {
  return `${origin}/s/${encodeURIComponent(id)}`;
}

/** Where a session can be changed: the token stands behind the #, which browsers send to no server. */
export function controlLink(id: string, token: string, origin: string): string {
  return `${watchLink(id, origin)}#control=${token}`;
}

/** The token in an address's part from # on; null where there is none. */
export function controlToken(hash: string): string | null {
  return CONTROL.exec(hash)?.[1] ?? null;
}

/** HTML that puts a session's stage, without panels, into another page. */
export function embedding(id: string, title: string, origin: string): string {
  const name = title.replace(/&/g, "&amp;").replace(/"/g, "&quot;").replace(/</g, "&lt;");
  return (
    `<iframe src="${watchLink(id, origin)}?clean=1" title="${name}" width="640" height="360" ` +
    `style="border: 0" allow="autoplay; fullscreen"></iframe>`
  );
}
