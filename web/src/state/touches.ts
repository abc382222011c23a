import { help } from "../words/help/en";

type Word = keyof typeof help;

/** What a finger does in one place of the page. */
export interface Touch {
  /** `Tap`, `Drag`, `Pinch`, `Hold`. */
  readonly shown: Word;
  readonly says: Word;
}

export interface TouchPlace {
  readonly place: Word;
  readonly touches: readonly Touch[];
}

/** Everything that is done by touch, each by the name of its message; the help lists it where there is no mouse. */
export const TOUCHES: readonly TouchPlace[] = [
  {
    place: "placeStage",
    touches: [
      { shown: "drag", says: "lookAround" },
      { shown: "pinch", says: "closer" },
      { shown: "dragTwo", says: "movePicture" },
      { shown: "tapPlayer", says: "follow" },
      { shown: "tapCamera", says: "giveBack" },
    ],
  },
  {
    place: "placeMusic",
    touches: [
      { shown: "tapLine", says: "goThere" },
      { shown: "holdDrag", says: "loop" },
      { shown: "pinch", says: "zoomLine" },
      { shown: "tapNote", says: "why" },
      { shown: "tapPart", says: "goToNote" },
    ],
  },
  {
    place: "placeShow",
    touches: [
      { shown: "drag", says: "scroll" },
      { shown: "pinch", says: "zoomTime" },
      { shown: "tapKey", says: "chooseKey" },
      { shown: "dragKey", says: "moveKey" },
      { shown: "hold", says: "menu" },
      { shown: "holdDrag", says: "chooseBox" },
      { shown: "tapRuler", says: "goToTime" },
    ],
  },
];
