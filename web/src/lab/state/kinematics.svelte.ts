import type {
  ForwardRequest,
  InverseAnswer,
  InverseRequest,
  LabChain,
  LabPose,
  ReachCells,
  ReachRequest,
  SolverChoice,
} from "../../generated/lab";
import type { LabApi } from "../api";
import { radians } from "../figures";
import { Latest } from "./latest";
import { trouble } from "./trouble";
import { kinematicsWords } from "../../words/lab-kinematics/en";

export type Vector = [number, number, number];
export type SolverName = SolverChoice["solver"];
export type PlaneName = NonNullable<ReachRequest["plane"]>;

const ITERATIVE: readonly SolverName[] = ["ccd", "fabrik", "damped_least_squares"];

/** The second table: a chain of the rig, posed by its angles or by a target. */
export class Kinematics {
  chains = $state.raw<readonly LabChain[]>([]);
  chain = $state.raw<LabChain | null>(null);
  pose = $state.raw<LabPose | null>(null);
  /** The last answer to a target; null while the joints are moved by hand. */
  answer = $state.raw<InverseAnswer | null>(null);
  reach = $state.raw<ReachCells | null>(null);
  /** Angles that are asked for and not answered yet, radians. */
  wanted = $state.raw<readonly number[] | null>(null);
  problem = $state<string | null>(null);
  target = $state<Vector>([0, 0, 0]);
  solver = $state<SolverName>("coupled_three_bone");
  limits = $state(true);
  iterations = $state(60);
  /** Millimetres. */
  tolerance = $state(0.1);
  /** Degrees. */
  phi = $state(-115);
  kappa = $state(0.3333);
  /** Degrees; null lets the server choose. */
  swivel = $state<number | null>(null);
  /** Whether an iterative solver goes on from the pose that is shown. */
  fromPose = $state(false);
  /** Which of an iterative solver's rounds is shown beside the result; null for none. */
  round = $state<number | null>(null);
  plane = $state<PlaneName>("xy");
  reachShown = $state(true);
  fansShown = $state(true);

  readonly #api: LabApi;
  readonly #forward: Latest<ForwardRequest, LabPose>;
  readonly #inverse: Latest<InverseRequest, InverseAnswer>;
  readonly #reach: Latest<ReachRequest, ReachCells>;
  #resting: ReturnType<typeof setTimeout> | undefined;

  constructor(api: LabApi) {
    this.#api = api;
    const failed = (error: unknown): void => {
      this.problem = trouble(error);
    };
    this.#forward = new Latest(
      (request) => api.forward(request),
      (pose, asked) => {
        this.#take(pose);
        // What was moved meanwhile is asked for next, and until then stands where it was put.
        if (this.wanted === asked.angles_rad) this.wanted = null;
        this.answer = null;
        this.round = null;
        this.target = [...(pose.positions.at(-1) ?? this.target)];
        this.#askReachSoon();
      },
      (error) => {
        this.wanted = null;
        failed(error);
      },
    );
    this.#inverse = new Latest(
      (request) => api.inverse(request),
      (answer) => {
        this.#take(answer.pose);
        this.answer = answer;
        if (answer.rounds.length === 0) this.round = null;
        else if (this.round !== null) this.round = Math.min(this.round, answer.rounds.length - 1);
      },
      failed,
    );
    this.#reach = new Latest(
      (request) => api.reach(request),
      (cells) => (this.reach = cells),
      failed,
    );
  }

  /** Whether what is shown is not yet what was asked for. */
  get busy(): boolean {
    return this.#forward.busy || this.#inverse.busy;
  }

  get iterative(): boolean {
    return ITERATIVE.includes(this.solver);
  }

  get reached(): boolean {
    return this.answer === null || this.answer.status === "reached";
  }

  async start(): Promise<void> {
    try {
      this.chains = await this.#api.chains();
      const first = this.chains.find((chain) => chain.name === "rightIndex") ?? this.chains[0];
      if (first === undefined) this.problem = kinematicsWords.noChains;
      else this.choose(first);
    } catch (error) {
      this.problem = trouble(error);
    }
  }

  /** Take another chain, a little bent, so that there is something to see. */
  choose(chain: LabChain): void {
    this.#forward.drop();
    this.#inverse.drop();
    this.#reach.drop();
    this.chain = chain;
    this.pose = chain.rest;
    this.answer = this.reach = this.round = null;
    if (!chain.solvers.includes(this.solver)) this.solver = chain.solvers[0] ?? this.solver;
    // Some way toward the limit that leaves more room.
    this.pushAngles(
      chain.hinges.map(({ axis, minimum_rad, maximum_rad }) =>
        axis === "x" && chain.kind === "limb" ? 0 : 0.3 * (maximum_rad > -minimum_rad ? maximum_rad : minimum_rad),
      ),
    );
  }

  /** Set one hinge, radians, as a slider does. */
  setAngle(hinge: number, angle: number): void {
    const angles = [...(this.wanted ?? this.pose?.hinges.map((one) => one.angle_rad) ?? [])];
    angles[hinge] = angle;
    this.pushAngles(angles);
  }

  toRest(): void {
    this.pushAngles((this.chain?.hinges ?? []).map(() => 0));
  }

  pushAngles(angles: number[]): void {
    if (this.chain === null) return;
    this.#inverse.drop();
    const { rig, name, hinges } = this.chain;
    const within = angles.map((angle, i) => {
      const hinge = hinges[i];
      return hinge === undefined || !this.limits
        ? angle
        : Math.min(Math.max(angle, hinge.minimum_rad), hinge.maximum_rad);
    });
    this.wanted = within;
    this.#forward.put({ rig, chain: name, angles_rad: within, limits: this.limits });
  }

  setTarget(target: Vector): void {
    this.target = target;
    this.solve();
  }

  /** Ask for the pose of the present target, and soon for the map around it. */
  solve(): void {
    if (this.chain === null) return;
    this.#forward.drop();
    this.wanted = null;
    const { rig, name } = this.chain;
    const start = this.fromPose && this.iterative ? this.pose?.hinges.map((hinge) => hinge.angle_rad) : undefined;
    this.#inverse.put({ rig, chain: name, target: [...this.target], choice: this.#choice(), start_rad: start ?? null });
    this.#askReachSoon();
  }

  setReachShown(shown: boolean): void {
    this.reachShown = shown;
    if (shown) this.#askReachSoon();
  }

  setPlane(plane: PlaneName): void {
    this.plane = plane;
    this.#askReachSoon();
  }

  #take(pose: LabPose): void {
    this.pose = pose;
    this.problem = null;
  }

  #choice(): SolverChoice {
    return {
      solver: this.solver,
      limits: this.limits,
      iterations: this.iterations,
      tolerance_m: this.tolerance / 1000,
      phi_rad: radians(this.phi),
      kappa: this.kappa,
      swivel_rad: this.swivel === null ? null : radians(this.swivel),
    };
  }

  /** The map takes the server some tenths of a second: only when things rest. */
  #askReachSoon(): void {
    clearTimeout(this.#resting);
    if (!this.reachShown) return;
    this.#resting = setTimeout(() => {
      if (this.chain === null) return;
      const { rig, name } = this.chain;
      this.#reach.put({ rig, chain: name, choice: this.#choice(), plane: this.plane, through: [...this.target] });
    }, 180);
  }
}
