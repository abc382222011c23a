/** The band room after school. */

import { Color, Group } from "three";

import type { TierSettings } from "../tiers";
import { createFloor, type Floor } from "./floor";
import { Feet } from "./feet";
import { createContactShade, type Patch } from "./contact-shade";
import { createFittings } from "./fittings";
import { createFurniture, FURNITURE_SHADE, ROW_SHADE } from "./furniture";
import { RESTING_SHADE } from "./instruments-at-rest";
import { KitPlace } from "./kit-place";
import { FloorMirror } from "./mirror";
import { RISERS } from "./plan";
import { createShafts } from "./shafts";
import type { RoomLight } from "./surface";
import { createWalls } from "./walls";

export { FOOT_JOINTS } from "./feet";
export { KIT_RIG, LEFT_HANDED_KIT_RIG } from "./kit-place";
export { RoomReflections } from "./reflections";

export interface Room {
  readonly object: Group;
  readonly floor: Floor["mesh"];
  readonly mirror: FloorMirror | null;
  readonly feet: Feet;
  /** What a drum kit stands on. */
  readonly kit: KitPlace;
  /** How thick the air in the sun is, or null where it is not drawn. */
  readonly haze: { value: number } | null;
  /** The key's colour times its intensity: what the windows shine with. */
  readonly keyColor: Color;
  /** How strongly the sky stands in the windows; 1 at rest. */
  readonly daylight: { value: number };
}

/** A step's front darkens the floor before it. */
const RISER_SHADE = RISERS.map(({ left, right, front }): Patch => [(left + right) / 2, front, right - left + 0.3, 0.5]);

/** The room, in the light that the lights keep up to date. */
export function createRoom(light: RoomLight, tier: TierSettings): Room {
  const keyColor = new Color(3, 2.4, 1.7);
  const daylight = { value: 1 };
  const feet = new Feet();
  const mirror = tier.mirrorScale > 0 ? new FloorMirror(tier.mirrorScale) : null;
  const { mesh: floor } = createFloor(light, mirror, feet);
  const object = new Group();
  const furniture = createFurniture(light);
  object.add(
    floor,
    createWalls(light, keyColor, daylight),
    createFittings(light),
    ...furniture.map(({ mesh }) => mesh),
  );
  const staying = [...RISER_SHADE, ...RESTING_SHADE, ...FURNITURE_SHADE];
  const shade = createContactShade([...staying, ...ROW_SHADE]);
  object.add(shade);
  const kit = new KitPlace(light, [...furniture, { mesh: shade, without: staying.length }]);
  object.add(kit.object);
  const shafts = tier.shafts ? createShafts(light.toKey, keyColor) : null;
  if (shafts !== null) object.add(shafts.mesh);
  return { object, floor, mirror, feet, kit, haze: shafts?.density ?? null, keyColor, daylight };
}
