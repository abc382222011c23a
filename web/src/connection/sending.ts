/** How a body is sent: who hears of it, and what ends it. */
export interface Sending {
  /** Told how many bytes of how many have left, each time that it is more. */
  readonly sent?: (bytes: number, of: number) => void;
  readonly signal?: AbortSignal;
}

/** No body may stand in an answer of these. */
const WITHOUT_BODY: readonly number[] = [204, 205, 304];

/**
 * What fetch does, telling how much has been sent: of that fetch says nothing.
 *
 * @throws TypeError where no answer comes, and the signal's reason where that ends it, as fetch does
 */
export function send(
  method: string,
  path: string,
  { headers, body, sent, signal }: Sending & { headers: Record<string, string>; body: XMLHttpRequestBodyInit },
): Promise<Response> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    const abort = (): void => {
      request.abort();
      reject(signal?.reason as Error);
    };
    if (signal?.aborted === true) {
      reject(signal.reason as Error);
      return;
    }
    request.open(method, path);
    for (const [name, value] of Object.entries(headers)) request.setRequestHeader(name, value);
    request.upload.onprogress = ({ loaded, total }) => sent?.(loaded, total);
    // Whatever was told before: all of it has left.
    request.upload.onload = ({ loaded }) => sent?.(loaded, loaded);
    request.onload = () => {
      const text = WITHOUT_BODY.includes(request.status) ? null : request.responseText;
      resolve(new Response(text, { status: request.status, headers: headersOf(request) }));
    };
    request.onerror = () => reject(new TypeError("no answer came"));
    request.onloadend = () => signal?.removeEventListener("abort", abort);
    signal?.addEventListener("abort", abort);
    request.send(body);
  });
}

function headersOf(request: XMLHttpRequest): Headers {
  const headers = new Headers();
  for (const line of request.getAllResponseHeaders().trim().split(/\r?\n/)) {
    const colon = line.indexOf(":");
    if (colon > 0) headers.append(line.slice(0, colon), line.slice(colon + 1).trim());
  }
  return headers;
}
