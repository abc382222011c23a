import { told } from "../words/told/en";
import { percent } from "./readout";
import type { SessionView } from "./session-view.svelte";

/** What the server does not decode, and so does not look for the score in. */
const UNHEARD = ["audio/mp4", "audio/webm"];

/** What is said of how far the score is in time with the recording: a line, and what more there is to it. */
export interface AlignmentWords {
  readonly title: string;
  readonly detail: string;
}

/** Whether the server looks for the score in the recording by itself. */
export function isListenedTo(view: SessionView): boolean {
  return !UNHEARD.includes((view.hello?.song ?? view.session.song).media_type);
}

/** How far a session's score is in time with its recording; null where its sound is made from the score. */
export function alignmentWords(view: SessionView): AlignmentWords | null {
  if (!view.isRecording) return null;
  if (!isListenedTo(view)) return { title: told.byHand, detail: "" };
  const { status, progress, confidence, detail } = view.alignment;
  switch (status) {
    case "searching":
      return { title: told.listening({ share: percent(progress) }), detail: "" };
    case "found":
      return { title: told.inTime({ share: percent(confidence ?? 0) }), detail: "" };
    case "unlike":
      return { title: told.unlike, detail: told.unlikeMeans };
    case "failed":
      return { title: told.notListened, detail: detail ?? "" };
    case "none":
      return null;
  }
}
