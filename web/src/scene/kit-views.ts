/** Views of a drummer and of what hands and feet do at the kit, relative to the kit. Each is framed for 16:9. */

import type { FramedView } from "./camera-presets";
import type { Stand } from "./players";

/** Where a drum kit stands and which way, metres and radians about +Y from facing the audience. */
export interface KitPlace {
  readonly x: number;
  /** Of what it stands on. */
  readonly y: number;
  readonly z: number;
  readonly facing: number;
  /** It is a left-handed player's, the mirror image of the other. */
  readonly mirrored: boolean;
}

export interface KitView extends FramedView {
  readonly name: "kit_behind" | "kit_overhead" | "kit_hi_hat" | "kit_feet";
}

/** In a right-handed player's kit's frame: from below the stool, +Z ahead and +X to the drummer's left. */
export const KIT_VIEWS: readonly KitView[] = [
  { name: "kit_behind", position: [0.62, 1.95, -1.35], target: [-0.05, 0.72, 0.5], fov: 0.72 },
  { name: "kit_overhead", position: [-0.12, 2.9, 0.1], target: [-0.12, 0.7, 0.42], fov: 0.78 },
  { name: "kit_hi_hat", position: [1.45, 1.42, 0.75], target: [0.22, 0.8, 0.46], fov: 0.5 },
  { name: "kit_feet", position: [0.95, 0.5, 1.0], target: [0.03, 0.12, 0.42], fov: 0.56 },
];

/** Who sits at the kit, from the side of the hi-hat and above the bass drum: past who stands before it, or from before them. */
const DRUMMER: readonly [FramedView, FramedView] = [
  { position: [1.75, 1.75, 2.55], target: [-0.12, 0.76, 0.3], fov: 0.6 },
  { position: [1.3, 1.75, 1.9], target: [-0.12, 0.76, 0.3], fov: 0.76 },
];

/**
 * What the views that every player has are at a kit: the first from which nobody else stands in the way is taken, or the
 * last. The face is seen between the crash cymbals and beside the notes that come.
 */
const AT_KIT: Readonly<Record<string, readonly FramedView[]>> = {
  whole_figure: [
    { position: [1.9, 1.55, 3.6], target: [-0.1, 0.72, 0.35], fov: 0.56 },
    { position: [0.8, 2.6, 3.5], target: [0, 0.8, 0.3], fov: 0.56 },
  ],
  three_quarter: DRUMMER,
  face: [{ position: [-0.2, 1.43, 1.62], target: [0, 1.24, 0.13], fov: 0.28 }],
  player: [{ position: [0, 1.32, 0.16], target: [-0.05, 0.68, 0.6], fov: 1.2 }],
};

/** How near to a camera's line of sight somebody stands in the way, and how high people are, metres. */
const IN_THE_WAY = 0.5;
const TALL = 2.1;

/**
 * The view of that name of who sits at a kit; null where a drummer has no other than everybody.
 *
 * @param others where the other players stand.
 */
export function kitView(name: string, kit: KitPlace, others: readonly Stand[] = []): FramedView | null {
  const views = AT_KIT[name] ?? KIT_VIEWS.filter((each) => each.name === name);
  const placed = views.map((view) => viewFrom(view, kit));
  return placed.find((view) => !others.some((stand) => hides(stand, view))) ?? placed.at(-1) ?? null;
}

/** The drummer and the whole kit. */
export function drummerView(kit: KitPlace, others: readonly Stand[] = []): FramedView {
  return kitView("three_quarter", kit, others) ?? viewFrom(DRUMMER[0], kit);
}

/** Whether somebody stands between a camera and what it looks at. */
function hides({ x, z }: Stand, { position, target }: FramedView): boolean {
  const [alongX, alongZ] = [target[0] - position[0], target[2] - position[2]];
  const share = ((x - position[0]) * alongX + (z - position[2]) * alongZ) / (alongX ** 2 + alongZ ** 2);
  const at = Math.min(Math.max(share, 0), 1);
  const away = Math.hypot(position[0] + at * alongX - x, position[2] + at * alongZ - z);
  return away < IN_THE_WAY && position[1] + at * (target[1] - position[1]) < TALL;
}

function viewFrom(view: FramedView, { x, y, z, facing, mirrored }: KitPlace): FramedView {
  const [sin, cos] = [Math.sin(facing), Math.cos(facing)];
  const placed = ([across, py, pz]: readonly [number, number, number]): [number, number, number] => {
    const px = mirrored ? -across : across;
    return [x + px * cos + pz * sin, y + py, z - px * sin + pz * cos];
  };
  return { position: placed(view.position), target: placed(view.target), fov: view.fov };
}
