import type { InterpolationComparison, InterpolationRequest } from "../../generated/lab";
import type { LabApi } from "../api";
import { degrees, radians } from "../figures";
import { WAYS, type WayName } from "../ways";
import { Latest } from "./latest";
import { trouble } from "./trouble";

export type EulerOrder = NonNullable<InterpolationRequest["euler_order"]>;
export type End = "start" | "end";

export const EULER_ORDERS: readonly EulerOrder[] = [
  ...(["zyx", "xyz", "yxz", "yzx", "zxy", "xzy"] as const),
  ...(["zxz", "zyz", "xyx", "xzx", "yxy", "yzy"] as const),
];
export const TIPS = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] } as const;
export const SAMPLES = 121;
/** How long the way from one end to the other lasts when it plays, seconds. */
const WAY_S = 3;

/** An orientation as it is being set: by three angles, or by an axis and an angle. */
export interface OrientationDraft {
  kind: "euler" | "axis_angle";
  order: EulerOrder;
  /** Degrees. */
  euler: [number, number, number];
  axis: [number, number, number];
  /** Degrees. */
  angle: number;
}

function draft(euler: [number, number, number]): OrientationDraft {
  return { kind: "euler", order: "zyx", euler, axis: [0, 1, 0], angle: 0 };
}

function sent(one: OrientationDraft): InterpolationRequest["start"] {
  if (one.kind === "axis_angle") return { kind: one.kind, axis: one.axis, angle_rad: radians(one.angle) };
  const [a, b, c] = one.euler;
  return { kind: one.kind, order: one.order, angles_rad: [radians(a), radians(b), radians(c)] };
}

/** The first table: two orientations, and four ways between them. */
export class Rotations {
  readonly ends = $state<Record<End, OrientationDraft>>({ start: draft([80, -20, -50]), end: draft([-60, 80, 80]) });
  order = $state<EulerOrder>("zyx");
  tip = $state<keyof typeof TIPS>("x");
  answer = $state.raw<InterpolationComparison | null>(null);
  problem = $state<string | null>(null);
  sample = $state(44);
  playing = $state(false);
  readonly shown = $state<Record<WayName, boolean>>({ slerp: true, matrix: true, euler: true, rotation_vector: true });
  readonly #asking: Latest<InterpolationRequest, InterpolationComparison>;

  constructor(api: LabApi) {
    this.#asking = new Latest(
      (request) => api.interpolations(request),
      (answer) => {
        this.answer = answer;
        this.problem = null;
      },
      (error) => (this.problem = trouble(error)),
    );
  }

  get visible(): readonly WayName[] {
    return (Object.keys(WAYS) as WayName[]).filter((name) => this.shown[name]);
  }

  get fraction(): number {
    return this.answer?.fractions[this.sample] ?? 0;
  }

  /** Go to where the way is after some seconds of going there and back, from its start. */
  playAt(seconds: number): void {
    const lap = (seconds / WAY_S) % 2;
    this.sample = Math.round((lap < 1 ? lap : 2 - lap) * (SAMPLES - 1));
  }

  /** The second of the going there at which the way is where it stands. */
  get playedSeconds(): number {
    return (this.sample / (SAMPLES - 1)) * WAY_S;
  }

  ask(): void {
    this.#asking.put({
      start: sent(this.ends.start),
      end: sent(this.ends.end),
      euler_order: this.order,
      samples: SAMPLES,
      tip: [...TIPS[this.tip]],
    });
  }

  /** Say the same orientation in another form; the server has already worked it out. */
  setKind(end: End, kind: OrientationDraft["kind"]): void {
    const one = this.ends[end];
    const forms = this.answer?.[end];
    if (forms !== undefined && one.kind !== kind) {
      const rounded = (value: number): number => Math.round(value * 100) / 100;
      one.order = this.order;
      one.euler = forms.euler_rad.map((angle) => rounded(degrees(angle))) as [number, number, number];
      one.axis = forms.axis.map((part) => Math.round(part * 10000) / 10000) as [number, number, number];
      one.angle = rounded(degrees(forms.angle_rad));
    }
    one.kind = kind;
    this.ask();
  }

  setOrder(order: EulerOrder): void {
    this.order = order;
    this.ask();
  }
}
