/** The lights of the stage, as the show sets them. */

import { AmbientLight, Color, DirectionalLight, Group, type Scene, Vector3 } from "three";

import { SPOT_COUNT, Spot } from "./spots";
import type { TierSettings } from "./tiers";

/** What every light looks at: the player's chest. */
const TARGET = new Vector3(0, 1.05, 0.1);

/** From the target, metres: within the reach of the shadows. */
const KEY_DISTANCE = 5;

/**
 * Half the width and height of what casts shadows about the target, metres: a player with the instrument raised; and
 * how far beyond the outermost of several players it goes.
 */
const SHADOW_REACH = 1.35;
const SHADOW_MARGIN = 0.75;
const SHADOW_BIAS = -0.0004;
const SHADOW_NORMAL_BIAS = 0.012;

export class StageLights {
  readonly key = new DirectionalLight(0xffffff, 3);
  readonly fill = new DirectionalLight(0xffffff, 0.5);
  readonly rim = new DirectionalLight(0xffffff, 1.5);
  readonly ambient = new AmbientLight(0xffffff, 0.1);
  /** Unit vector from the player to the key, in the world. */
  readonly toKey = new Vector3(-0.6, 0.5, 0.6);
  readonly spots: readonly Spot[] = Array.from({ length: SPOT_COUNT }, () => new Spot());
  /** How much of the spots' cones shows in the air. */
  haze = 0.5;
  readonly backWash = { color: new Color(0.07, 0.14, 0.32), intensity: 0 };
  /** The wash's colour times its intensity. */
  readonly washed = new Color(0, 0, 0);
  /** How soft the key's shadows are; 1 at rest. */
  softness = 1;
  readonly #target = new Group();
  readonly #shadowRadius: number;

  constructor(scene: Scene, tier: TierSettings) {
    this.#target.position.copy(TARGET);
    // The key stays first: the room's surfaces take it through the windows (room/surface.ts).
    for (const light of [this.key, this.fill, this.rim]) {
      light.target = this.#target;
      scene.add(light);
    }
    scene.add(this.ambient, this.#target);
    for (const { light, cone } of this.spots) scene.add(light, light.target, cone);
    this.#shadowRadius = tier.shadowMapSize / 256;
    this.key.position.set(-2.5, 2.8, 2.6);
    this.rim.position.set(1.6, 2.6, -2.2);
    if (tier.shadowMapSize > 0) {
      this.key.castShadow = true;
      const { shadow } = this.key;
      shadow.mapSize.setScalar(tier.shadowMapSize);
      shadow.camera.left = shadow.camera.bottom = -SHADOW_REACH;
      shadow.camera.right = shadow.camera.top = SHADOW_REACH;
      shadow.camera.near = 0.1;
      shadow.camera.far = 14;
      shadow.bias = SHADOW_BIAS;
      shadow.normalBias = SHADOW_NORMAL_BIAS;
    }
  }

  /** Whether the spots are among the lights that surfaces are drawn with. */
  get spotsLit(): boolean {
    return this.spots[0]?.light.visible ?? false;
  }

  /** Light the spots or none: what is lit counts in every surface's shader, so that it is all of them at once. */
  lightSpots(lit: boolean): void {
    for (const { light } of this.spots) light.visible = lit;
  }

  /**
   * Cast the shadows of everybody who stands here: the key's picture of them is as wide as they stand apart, metres.
   *
   * @param beside how far from the middle there is anything else whose shadow counts.
   */
  reach(stands: readonly { readonly x: number; readonly z: number }[], beside = 0): void {
    // To the next ten centimetres: who only sways changes nothing.
    const spread = Math.ceil(10 * Math.max(0, ...stands.map(({ x }) => Math.abs(x - TARGET.x)))) / 10;
    const reach = Math.max(SHADOW_REACH, spread + SHADOW_MARGIN, beside);
    const { camera } = this.key.shadow;
    if (camera.right === reach) return;
    // A map that is stretched for more than players has coarser texels, of which a cymbal would shade itself.
    const coarser = beside > 0 ? reach / SHADOW_REACH : 1;
    this.key.shadow.bias = SHADOW_BIAS * coarser;
    this.key.shadow.normalBias = SHADOW_NORMAL_BIAS * coarser;
    camera.left = camera.bottom = -reach;
    camera.right = camera.top = reach;
    camera.updateProjectionMatrix();
  }

  /** Follow the key's place: only its direction counts, and the fill stands across from it. */
  arrange(songTime: number): void {
    let lit = false;
    for (const spot of this.spots) {
      spot.arrange(this.haze, songTime);
      lit ||= spot.light.intensity > 0;
    }
    this.lightSpots(lit);
    this.washed.copy(this.backWash.color).multiplyScalar(this.backWash.intensity);
    this.key.shadow.radius = this.#shadowRadius * this.softness;
    const { key, fill } = this;
    this.toKey.subVectors(key.position, TARGET).normalize();
    key.position.copy(this.toKey).multiplyScalar(KEY_DISTANCE).add(TARGET);
    fill.position.set(TARGET.x - this.toKey.x * 3, TARGET.y + 0.7, TARGET.z + 2.4);
  }

  dispose(): void {
    this.key.dispose();
    this.fill.dispose();
    this.rim.dispose();
    for (const { light } of this.spots) light.dispose();
  }
}
