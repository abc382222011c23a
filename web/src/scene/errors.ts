/** The stage cannot be drawn on this device. Its message is for the person in front of it. */
export class StageUnavailableError extends Error {
  override readonly name = "StageUnavailableError";
}
