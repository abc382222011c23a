/** A chain with its joints, limits and target, among the rig's other bones. */

import { Group, Mesh, MeshBasicMaterial, Quaternion, RingGeometry, SphereGeometry, Vector3 } from "three";
import type { Line2 } from "three/addons/lines/Line2.js";

import type { LabChain, LabPose, ReachCells, SolverRound } from "../../generated/lab";
import { AXIS_COLOURS, BRASS, PAPER, RIBBON } from "./palette";
import { Bones, brass, Fan, ghost, Gizmo, matte, release, setLine, thickLine } from "./parts";
import { ReachSurface } from "./reach-surface";
import type { Figure } from "./view";

const X = new Vector3(1, 0, 0);
const Y = new Vector3(0, 1, 0);
const Z = new Vector3(0, 0, 1);
const SIDES: Record<LabChain["kind"], readonly number[]> = { finger: [0.45, 0.5, 1.5], limb: [-0.55, 0.3, 1.5] };

export class ChainFigure implements Figure {
  readonly object = new Group();
  readonly frame: Figure["frame"];
  /** What is dragged. */
  readonly handle: Mesh;
  readonly #bones: Bones;
  readonly #steps: Bones;
  readonly #fans: readonly Fan[];
  readonly #gizmos: readonly Gizmo[];
  readonly #ring: Mesh<RingGeometry, MeshBasicMaterial>;
  readonly #gap: Line2;
  readonly #trail: Line2;
  readonly #surface = new ReachSurface();
  readonly #reach: number;

  constructor(chain: LabChain) {
    this.#reach = chain.reach_m;
    const base = chain.rest.positions[0] ?? [0, 0, 0];
    this.frame = { centre: base, radius: chain.reach_m * 1.18, from: SIDES[chain.kind] };
    this.#bones = new Bones(chain.joints.length, brass());
    this.#steps = new Bones(chain.joints.length, ghost(0.22));
    this.#steps.mesh.visible = false;
    const around = new Bones(chain.around.length, matte());
    chain.around.forEach(([start, end], i) => around.set(i, start, end, 0.11, 0.006 * chain.reach_m));
    around.finish();
    this.#fans = chain.hinges.map((hinge) => new Fan(AXIS_COLOURS[hinge.axis]));
    this.#gizmos = chain.joints.map(() => new Gizmo(2));
    const size = 0.045 * chain.reach_m;
    this.handle = new Mesh(new SphereGeometry(size, 24, 16), new MeshBasicMaterial({ color: PAPER }));
    this.#ring = new Mesh(
      new RingGeometry(1.5 * size, 1.85 * size, 40),
      new MeshBasicMaterial({ color: BRASS, side: 2 }),
    );
    this.#gap = thickLine(RIBBON, 2, { dash: [0.02 * chain.reach_m, 0.014 * chain.reach_m] });
    this.#trail = thickLine(PAPER, 1.5, { opacity: 0.7 });
    this.#trail.visible = false;
    this.object.add(
      this.#surface.mesh,
      around.mesh,
      this.#bones.mesh,
      this.#steps.mesh,
      ...this.#fans.map((fan) => fan.object),
      ...this.#gizmos.map((gizmo) => gizmo.object),
      this.handle,
      this.#ring,
      this.#gap,
      this.#trail,
    );
  }

  setPose(pose: LabPose): void {
    this.#place(this.#bones, pose.positions);
    pose.hinges.forEach((hinge, i) => {
      this.#fans[i]?.set(hinge.origin, hinge.fan, hinge.direction, hinge.radius_m);
    });
    const turn = new Quaternion();
    pose.orientations.forEach((orientation, i) => {
      turn.set(...orientation);
      const columns = [X, Y, Z].map((axis) => axis.clone().applyQuaternion(turn).toArray());
      this.#gizmos[i]?.set(pose.positions[i] ?? [], columns, 0.12 * this.#reach);
    });
  }

  /** Put the target somewhere; a gap to the end is drawn where there is one. */
  setTarget(target: readonly number[], end: readonly number[], reached: boolean): void {
    const [x = 0, y = 0, z = 0] = target;
    this.handle.position.set(x, y, z);
    this.#ring.position.set(x, y, z);
    this.#ring.material.color.set(reached ? BRASS : RIBBON);
    this.#gap.visible = !reached;
    setLine(this.#gap, [...end, x, y, z]);
  }

  /** A round of an iterative solver as a shadow beside the result, and the way of the end; null hides both. */
  setRound(rounds: readonly SolverRound[], shown: number | null): void {
    const round = shown === null ? undefined : rounds[shown];
    this.#steps.mesh.visible = this.#trail.visible = round !== undefined;
    if (round === undefined) return;
    this.#place(this.#steps, round.positions);
    const way = rounds.flatMap((one) => one.positions.at(-1) ?? []);
    setLine(this.#trail, way.length > 3 ? way : [...way, ...way]);
  }

  setReach(cells: ReachCells | null): void {
    this.#surface.set(cells);
  }

  setFans(shown: boolean): void {
    for (const fan of this.#fans) fan.object.visible = shown;
  }

  /** The target's ring faces the camera. */
  face(camera: Quaternion): void {
    this.#ring.quaternion.copy(camera);
  }

  dispose(): void {
    release(this.object);
  }

  #place(bones: Bones, positions: readonly (readonly number[])[]): void {
    for (let i = 0; i + 1 < positions.length; i++) bones.set(i, positions[i] ?? [], positions[i + 1] ?? [], 0.12);
    bones.finish();
  }
}
