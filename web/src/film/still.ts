/** A picture of one moment, as large as a film's and as finely drawn. */

import type { Hello } from "../generated/protocol";
import type { CameraView, ScoreView, Tier } from "../scene";
import { FilmStage } from "./film-stage";
import type { FilmFrame } from "./frames";
import { holdView } from "./held-view";
import type { PictureSize } from "./picture-size";
import { film } from "../words/film/en";

export interface StillOrder {
  readonly hello: Hello;
  readonly score: ScoreView;
  /** The frame that is seen. */
  readonly frame: FilmFrame;
  /** The view that it is seen from. */
  readonly view: CameraView;
  readonly size: PictureSize;
  readonly tier: Tier;
  /** Nothing but the players, on nothing. */
  readonly transparent: boolean;
}

/** Draw a still; a PNG. */
export async function drawStill(order: StillOrder): Promise<Blob> {
  const stage = await FilmStage.open(order.hello, order.score, order);
  try {
    holdView(order.hello.parameters, order.view)(order.frame.floats);
    stage.draw(order.frame);
    const picture = await new Promise<Blob | null>((resolve) => stage.canvas.toBlob(resolve, "image/png"));
    if (picture === null) throw new Error(film.pictureTooLarge);
    return picture;
  } finally {
    stage.dispose();
  }
}
