/** For who wants less motion: the camera stands still within a shot, and goes on with the next cut. */

import { Vector3 } from "three";

import type { ShowPose } from "./camera";

/** When a pose is shown: what of a frame says so. */
export interface Moment {
  readonly songTime: number;
  readonly epoch: number;
  /** How many frames that are cuts have been passed. */
  readonly cuts: number;
}

/** A drive goes no faster than this, metres a second, and no frame rests more exactly than this, metres. */
const DRIVE_M_S = 2;
const REST_M = 0.05;
/** Further than this between two pictures of different epochs is a seek, seconds; nearer they may be play or pause. */
const SEEK_S = 0.5;
const ZOOM_RAD_S = 0.6;
const REST_RAD = 0.02;

export class StillShots {
  readonly #held: ShowPose = { position: new Vector3(), target: new Vector3(), fov: 0, roll: 0 };
  readonly #last: ShowPose = { position: new Vector3(), target: new Vector3(), fov: 0, roll: 0 };
  #lastMoment: Moment | null = null;

  /** Put in a frame's pose what was seen first of its shot; a seek begins it anew, and an edit of the camera. */
  still(pose: ShowPose, moment: Moment): void {
    const begins = this.#begins(pose, moment);
    copy(pose, this.#last);
    this.#lastMoment = { songTime: moment.songTime, epoch: moment.epoch, cuts: moment.cuts };
    if (begins) copy(pose, this.#held);
    else copy(this.#held, pose);
  }

  #begins(pose: ShowPose, moment: Moment): boolean {
    const before = this.#lastMoment;
    if (before === null) return true;
    const seconds = Math.abs(moment.songTime - before.songTime);
    const changed = before.epoch !== moment.epoch;
    if (changed && seconds > SEEK_S) return true;
    return (changed || before.cuts !== moment.cuts) && this.#jumped(pose, seconds);
  }

  /** A cut may be a light's alone: then the camera has gone no further than it drives. */
  #jumped({ position, target, fov }: ShowPose, seconds: number): boolean {
    const far = REST_M + DRIVE_M_S * seconds;
    const last = this.#last;
    return (
      position.distanceTo(last.position) > far ||
      target.distanceTo(last.target) > far ||
      Math.abs(fov - last.fov) > REST_RAD + ZOOM_RAD_S * seconds
    );
  }
}

function copy(from: ShowPose, to: ShowPose): void {
  to.position.copy(from.position);
  to.target.copy(from.target);
  to.fov = from.fov;
  to.roll = from.roll;
}
