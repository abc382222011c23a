/** Views of a drummer and of what hands and feet do at the kit, relative to the kit. Each is framed for 16:9. */

import type { FramedView } from "./camera-presets";

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

/** Who sits at the kit, from the side of the hi-hat, above the bass drum and past who stands before it. */
const DRUMMER: FramedView = { position: [1.75, 1.75, 2.55], target: [-0.12, 0.76, 0.3], fov: 0.6 };

/** The view of that name of who sits at a kit; null where a drummer has no other than everybody. */
export function kitView(name: string, kit: KitPlace): FramedView | null {
  if (name === "three_quarter") return drummerView(kit);
  const view = KIT_VIEWS.find((each) => each.name === name);
  return view === undefined ? null : viewFrom(view, kit);
}

/** The drummer and the whole kit. */
export function drummerView(kit: KitPlace): FramedView {
  return viewFrom(DRUMMER, kit);
}

function viewFrom(view: FramedView, { x, y, z, facing, mirrored }: KitPlace): FramedView {
  const [sin, cos] = [Math.sin(facing), Math.cos(facing)];
  const placed = ([across, py, pz]: readonly [number, number, number]): [number, number, number] => {
    const px = mirrored ? -across : across;
    return [x + px * cos + pz * sin, y + py, z - px * sin + pz * cos];
  };
  return { position: placed(view.position), target: placed(view.target), fov: view.fov };
}
