/** Whether another page shows this one in a frame: what is tapped there may be meant for that page. */
export function isFramed(): boolean {
  return globalThis.top !== globalThis.self;
}
