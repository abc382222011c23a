/** What each tier of device draws. */

export type Tier = "full" | "medium" | "low";

export interface TierSettings {
  readonly largestPixelRatio: number;
  /** Texels along a side of the key's shadow map; 0 casts no shadow. */
  readonly shadowMapSize: number;
  /** Size of the floor's mirror image as a share of the picture; 0 leaves only the room's own reflection. */
  readonly mirrorScale: number;
  /** Texels along a side of each face of the reflected room. */
  readonly environmentSize: number;
  /** Draws the sun in the air. */
  readonly shafts: boolean;
  /** Shades skin with light that passes under it, and cloth with its sheen. */
  readonly softSurfaces: boolean;
  /** Draws into a picture with a wide range of light first, whose brightest parts bloom. */
  readonly bloom: boolean;
  /** Blurs what is out of focus. */
  readonly depthOfField: boolean;
}

export const TIERS: Readonly<Record<Tier, TierSettings>> = {
  full: {
    largestPixelRatio: 2,
    shadowMapSize: 2048,
    mirrorScale: 0.5,
    environmentSize: 256,
    shafts: true,
    softSurfaces: true,
    bloom: true,
    depthOfField: true,
  },
  medium: {
    largestPixelRatio: 1.5,
    shadowMapSize: 1024,
    mirrorScale: 0,
    environmentSize: 128,
    shafts: true,
    softSurfaces: true,
    bloom: true,
    depthOfField: false,
  },
  low: {
    largestPixelRatio: 1,
    shadowMapSize: 0,
    mirrorScale: 0,
    environmentSize: 128,
    shafts: false,
    softSurfaces: false,
    bloom: false,
    depthOfField: false,
  },
};
