/** What a finger does in one place of the page. */
export interface Touch {
  /** `Tap`, `Drag`, `Pinch`, `Hold`. */
  readonly shown: string;
  readonly says: string;
}

export interface TouchPlace {
  readonly place: string;
  readonly touches: readonly Touch[];
}

/** Everything that is done by touch; the help lists it where there is no mouse. */
export const TOUCHES: readonly TouchPlace[] = [
  {
    place: "The stage",
    touches: [
      { shown: "Drag", says: "Look around the player" },
      { shown: "Pinch", says: "Closer or further away" },
      { shown: "Drag with two", says: "Move the picture" },
      { shown: "Tap a player", says: "Follow that player's notes" },
      { shown: "Tap the camera", says: "Give the camera back to the show" },
    ],
  },
  {
    place: "The music",
    touches: [
      { shown: "Tap the line", says: "Go to that place; drag along it to search" },
      { shown: "Hold, then drag", says: "Along the line: play it in a loop; a tap on the loop ends it" },
      { shown: "Pinch", says: "Zoom the line" },
      { shown: "Tap a note", says: "Why it is fingered so" },
      { shown: "Tap the part", says: "On paper: go to that note" },
    ],
  },
  {
    place: "The show, while it is open",
    touches: [
      { shown: "Drag", says: "Along the time, up and down the rows" },
      { shown: "Pinch", says: "Zoom the time" },
      { shown: "Tap a keyframe", says: "Choose it; Values shows what it holds" },
      { shown: "Drag a keyframe", says: "Move it" },
      { shown: "Hold", says: "A menu of what can be done there" },
      { shown: "Hold, then drag", says: "Choose all keyframes in a box" },
      { shown: "Tap the ruler", says: "Go to that time" },
    ],
  },
];
