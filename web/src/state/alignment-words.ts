import { told } from "../words/told/en";
import { percent } from "./readout";
import type { SessionView } from "./session-view.svelte";

/** What the server does not decode, and so looks for the score in only once this page has. */
const UNDECODED = ["audio/mp4", "audio/webm"];

/** What is said of how far the score is in time with the recording: a line, and what more there is to it. */
export interface AlignmentWords {
  readonly title: string;
  readonly detail: string;
}

/** Whether the server has listened to the recording, or will by itself. */
export function isListenedTo(view: SessionView): boolean {
  return !UNDECODED.includes((view.hello?.song ?? view.session.song).media_type) || view.alignment.status !== "none";
}

/** How far a session's score is in time with its recording; null where its sound is made from the score. */
export function alignmentWords(view: SessionView): AlignmentWords | null {
  if (!view.isRecording) return null;
  if (!isListenedTo(view)) {
    return view.sending ? { title: told.sending, detail: "" } : { title: told.notSent, detail: told.notSentMeans };
  }
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
