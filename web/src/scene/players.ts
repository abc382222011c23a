/** Who stands on the stage: each player's body, and where the notes come to. */

import { type Object3D, type Ray, Vector3 } from "three";

import type { RigModel, RigPoint } from "../rig";
import { DRUM_PIECES } from "./blocks/staff";
import type { KitPlace } from "./kit-views";
import { LEFT_HANDED_KIT_RIG } from "./room";

/** How near to a player's middle a ray has to pass, metres: an arm's breadth. */
const REACH = 0.3;
const BELL_NODE = "socket_bell";
/** A drum kit's root. */
const KIT_JOINT = "kit";

/** Of an instrument without a bell: where its lane begins, and where a piece is met if not where it is struck. */
const LANE_CONTACT = "lane";

interface StandingPlayer {
  readonly hips: Object3D | null;
  readonly head: Object3D | null;
  readonly feet: readonly Object3D[];
  /** Where the lane of notes begins. */
  readonly lane: RigPoint | null;
  /** Where the notes of each of `DRUM_PIECES` come to. */
  readonly pieces: readonly (RigPoint | null)[];
  readonly kit: Object3D | null;
  readonly kitMirrored: boolean;
}

/** Where a player stands and which way, metres and radians about +Y from facing the audience. */
export interface Stand {
  readonly x: number;
  readonly z: number;
  readonly facing: number;
}

const low = new Vector3();
const high = new Vector3();
const ahead = new Vector3();

export class Players {
  readonly #players: StandingPlayer[] = [];

  /** @param models with the player that each belongs to, a place in the cast. */
  constructor(models: readonly { readonly model: RigModel; readonly player: number }[]) {
    for (let player = 0; models.some((each) => each.player === player); player++) {
      const own = models.filter((each) => each.player === player).map(({ model }) => model);
      this.#players.push({
        hips: findJoint(own, "hips"),
        head: findJoint(own, "head"),
        feet: ["leftFoot", "rightFoot"].flatMap((joint) => findJoint(own, joint) ?? []),
        lane: findLane(own),
        pieces: DRUM_PIECES.map((piece) => findPiece(own, piece)),
        kit: findJoint(own, KIT_JOINT),
        kitMirrored: own.some(({ rig }) => rig === LEFT_HANDED_KIT_RIG),
      });
    }
  }

  get count(): number {
    return this.#players.length;
  }

  /**
   * Take where each lane begins, and each piece that is struck, in the world; after the scene's world matrices are up to date.
   *
   * @param pieces `DRUM_PIECES` of the first player, then of the second, and so on; those that nobody has stay.
   */
  readLanes(starts: readonly Vector3[], pieces: readonly Vector3[]): void {
    this.#players.forEach((each, player) => {
      readPoint(each.lane, starts[player]);
      each.pieces.forEach((piece, number) => readPoint(piece, pieces[player * DRUM_PIECES.length + number]));
    });
  }

  /** Whether each plays at a kit, in the cast's order. */
  atKits(): boolean[] {
    return this.#players.map(({ kit }) => kit !== null);
  }

  /** Where everybody stands, in the cast's order. */
  stands(): Stand[] {
    return this.#players.map(({ hips }) => {
      if (hips === null) return { x: 0, z: 0, facing: 0 };
      low.setFromMatrixPosition(hips.matrixWorld);
      ahead.setFromMatrixColumn(hips.matrixWorld, 2);
      return { x: low.x, z: low.z, facing: Math.atan2(ahead.x, ahead.z) };
    });
  }

  /** Where a player's drum kit stands; null of who has none. */
  kit(player: number): KitPlace | null {
    const { kit = null, kitMirrored: mirrored = false } = this.#players[player] ?? {};
    if (kit === null) return null;
    const { x, y, z } = low.setFromMatrixPosition(kit.matrixWorld);
    ahead.setFromMatrixColumn(kit.matrixWorld, 2);
    return { x, y, z, facing: Math.atan2(ahead.x, ahead.z), mirrored };
  }

  /** The player whom a ray meets first, a place in the cast; null for none. */
  pick(ray: Ray): number | null {
    let nearest = Number.POSITIVE_INFINITY;
    let picked: number | null = null;
    this.#players.forEach(({ head, feet }, player) => {
      if (head === null) return;
      high.setFromMatrixPosition(head.matrixWorld);
      low.set(0, 0, 0);
      for (const foot of feet) low.addScaledVector(ahead.setFromMatrixPosition(foot.matrixWorld), 1 / feet.length);
      if (feet.length === 0) low.copy(high).setY(0);
      const away = ray.distanceSqToSegment(low, high, ahead);
      const distance = ahead.distanceTo(ray.origin);
      if (away > REACH * REACH || distance >= nearest) return;
      nearest = distance;
      picked = player;
    });
    return picked;
  }
}

function findJoint(models: readonly RigModel[], joint: string): Object3D | null {
  return first(models, (model) => model.findJoint(joint));
}

/** The mouth of the first bell among the models, the rig's contact or else the model's socket; of a kit its own contact. */
function findLane(models: readonly RigModel[]): RigPoint | null {
  for (const model of models) {
    const contact = model.findContact("bell");
    if (contact !== null) return contact;
    const node = model.object.getObjectByName(BELL_NODE);
    if (node !== undefined) return { node, offset: new Vector3() };
  }
  return first(models, (model) => model.findContact(LANE_CONTACT));
}

function findPiece(models: readonly RigModel[], piece: string): RigPoint | null {
  return first(models, (model) => model.findContact(`${LANE_CONTACT}_${piece}`) ?? model.findZone(piece));
}

function first<T>(models: readonly RigModel[], of: (model: RigModel) => T | null): T | null {
  for (const model of models) {
    const found = of(model);
    if (found !== null) return found;
  }
  return null;
}

function readPoint(point: RigPoint | null, into: Vector3 | undefined): void {
  if (point !== null) into?.copy(point.offset).applyMatrix4(point.node.matrixWorld);
}
