// Written by `make generate` from server/reina/protocol; do not edit. Field names are the wire's.

/** Four ways between two orientations. */
export interface InterpolationComparison {
  start: OrientationForms
  end: OrientationForms
  /** The angle between them: no way is shorter. */
  angle_rad: number
  fractions: number[]
  ways: InterpolationWay[]
}

/** Every chain of every player's rig that can be posed. */
export interface LabChainList {
  chains: LabChain[]
}

/** A posed chain in the frame of the joint that carries it. */
export interface LabPose {
  /** Of the joints, then of the end. */
  positions: ([number, number, number])[]
  /** Of the joints. */
  orientations: ([number, number, number, number])[]
  hinges: HingeState[]
  finger: FingerAngles | null
}

/** What a solver found. */
export interface InverseAnswer {
  status: "reached" | "out_of_reach" | "at_limit" | "not_converged"
  /** Distance of the end from the target, by forward kinematics of the angles. */
  error_m: number
  /** 0 for closed forms. */
  iterations: number
  /** Of an iterative solver, the start first. */
  rounds: SolverRound[]
  pose: LabPose
}

/** Which cells of a plane the end of a chain comes to, each solved from rest. */
export interface ReachCells {
  /** Centre of the first cell. */
  corner: [number, number, number]
  /** From a cell to the next in its row. */
  right: [number, number, number]
  /** From a row to the next. */
  up: [number, number, number]
  columns: number
  rows: number
  /** Row by row, 1 where the solver comes to the cell's centre, 0 where not. */
  reached: string
  /** Part of the cells that it comes to. */
  share: number
}

/** The shipped clips. */
export interface LabClipList {
  clips: LabClip[]
}

/** A BVH file, read, with everything's place in the world frame by frame. */
export interface ParsedClip {
  joints: ClipJoint[]
  /** In the file; 0 for a skeleton without motion. */
  frames: number
  frame_time_s: number
  duration_s: number
  /** What is not as the file says, and what was made of it. */
  warnings: Warned[]
  /** Names: joints in their order, then end sites. */
  points: string[]
  /** The point that each hangs from; -1 for the root. */
  point_parents: number[]
  /** Every frame_step-th frame has positions; 1 means all. */
  frame_step: number
  /** How many have; of a file without frames one, at rest. */
  sampled_frames: number
  /** Corner of the box around all positions, in the file's unit. */
  minimum: [number, number, number]
  maximum: [number, number, number]
  /** Base64 of little-endian float32 (sampled_frames, points, 3), in the file's unit. */
  positions: string
}

/**
 * Two orientations, and how to go from one to the other.
 *
 * Angles that are given are interpolated as they are given, in the order that is interpolated: 270° goes
 * another way than -90°.
 */
export interface InterpolationRequest {
  start: EulerOrientation | AxisAngleOrientation | QuaternionOrientation
  end: EulerOrientation | AxisAngleOrientation | QuaternionOrientation
  /** Of the Euler angles that are interpolated. */
  euler_order?: "xyz" | "xzy" | "yxz" | "yzx" | "zxy" | "zyx" | "xyx" | "xzx" | "yxy" | "yzy" | "zxz" | "zyz"
  samples?: number
  /** The point of the turned body whose path is told. */
  tip?: [number, number, number]
}

/** Angles for every hinge of a chain. */
export interface ForwardRequest {
  rig?: string
  chain: string
  /** From rest, in the order of the chain's hinges. */
  angles_rad: number[]
  /** Whether an angle beyond the rig's limits is refused. */
  limits?: boolean
}

/** A target for the end of a chain, in the frame of the joint that carries it. */
export interface InverseRequest {
  rig?: string
  chain: string
  target: [number, number, number]
  choice: SolverChoice
  /** Hinge angles that an iterative solver begins from; rest where null. */
  start_rad?: number[] | null
}

/** A plane through a point, to be asked cell by cell. */
export interface ReachRequest {
  rig?: string
  chain: string
  choice: SolverChoice
  plane?: "xy" | "yz" | "xz"
  through: [number, number, number]
}

/** An orientation by an axis of any length and an angle about it. */
export interface AxisAngleOrientation {
  kind: "axis_angle"
  axis: [number, number, number]
  angle_rad: number
}

/** One joint of a clip. */
export interface ClipJoint {
  name: string
  /** Its index, None for the root. */
  parent: number | null
  offset: [number, number, number]
  channels: string[]
}

/** An orientation by three angles; zyx is Rz Ry Rx. */
export interface EulerOrientation {
  kind: "euler"
  order: "xyz" | "xzy" | "yxz" | "yzx" | "zxy" | "zyx" | "xyx" | "xzx" | "yxy" | "yzy" | "zxz" | "zyz"
  angles_rad: [number, number, number]
}

/** A finger's angles as the planar arm counts them; flexion is negative. */
export interface FingerAngles {
  abduction_rad: number
  theta_rad: [number, number, number]
  /** The last bone's direction, θ1 + θ2 + θ3. */
  phi_rad: number
}

/** One hinge of a posed chain. */
export interface HingeState {
  /** From rest. */
  angle_rad: number
  /** By how much it is beyond the rig's limits; 0 within. */
  beyond_rad: number
  origin: [number, number, number]
  axis: [number, number, number]
  /** Unit directions from the least to the greatest angle. */
  fan: ([number, number, number])[]
  /** The present one among them. */
  direction: [number, number, number]
  /** How large to draw the fan. */
  radius_m: number
}

/** One way, sampled at the answer's fractions. */
export interface InterpolationWay {
  name: "slerp" | "matrix" | "euler" | "rotation_vector"
  /** The rotations; of matrix those nearest to its matrices. */
  quaternions: ([number, number, number, number])[]
  /** Where the body's x, y and z go: the matrices' columns, as they were interpolated. */
  axes: ([[number, number, number], [number, number, number], [number, number, number]])[]
  /** Where the tip goes. */
  tip: ([number, number, number])[]
  /** Angular speed between samples, radians a unit of the fraction: one fewer than samples. */
  speed: number[]
  /** Of the matrices; 1 for a rotation. */
  determinant: number[]
  /** Frobenius norm of RᵀR - I; 0 for a rotation. */
  orthogonality_error: number[]
  /** How far the body turns on the way. */
  length_rad: number
  /** The least speed. */
  slowest: number
  /** The greatest speed. */
  fastest: number
}

/** A chain that can be posed. */
export interface LabChain {
  rig: string
  name: string
  kind: "finger" | "limb"
  /** The joint that carries it: all positions are in its frame. */
  carrier: string
  joints: string[]
  /** What is brought to the target. */
  end: string
  bone_lengths_m: number[]
  reach_m: number
  /** Those that can solve it; the first is the one that the rig plays with. */
  solvers: ("planar_three_bone" | "coupled_three_bone" | "two_bone" | "ccd" | "fabrik" | "damped_least_squares")[]
  hinges: LabHinge[]
  rest: LabPose
  /** The rig's other bones at rest. */
  around: ([[number, number, number], [number, number, number]])[]
}

/** A motion clip that ships with a rig. */
export interface LabClip {
  rig: string
  name: string
  href: string
  joints: number
  frames: number
  duration_s: number
}

/** One angle of a chain. */
export interface LabHinge {
  joint: string
  axis: "x" | "y" | "z"
  /** From rest. */
  minimum_rad: number
  /** From rest. */
  maximum_rad: number
}

/** One orientation in every form. */
export interface OrientationForms {
  quaternion: [number, number, number, number]
  axis: [number, number, number]
  angle_rad: number
  /** In the order that is interpolated. */
  euler_rad: [number, number, number]
}

/** An orientation by a quaternion of any length. */
export interface QuaternionOrientation {
  kind: "quaternion"
  quaternion: [number, number, number, number]
}

/** Which solver, and how. */
export interface SolverChoice {
  solver: "planar_three_bone" | "coupled_three_bone" | "two_bone" | "ccd" | "fabrik" | "damped_least_squares"
  /** Whether joints stop at the rig's limits. */
  limits?: boolean
  /** The bound of an iterative solver's rounds. */
  iterations?: number
  /** How near the end must come. */
  tolerance_m?: number
  /** Direction of the last bone for planar_three_bone. */
  phi_rad?: number
  /** θ3 / θ2 for coupled_three_bone. */
  kappa?: number
  /** For two_bone: turn of the elbow or knee about the line to the target; null to have one chosen. */
  swivel_rad?: number | null
}

/** Where an iterative solver's chain was after a round. */
export interface SolverRound {
  error_m: number
  positions: ([number, number, number])[]
}

/** Something in a file that could not be taken as it stands, and what was done instead. */
export interface Warned {
  kind: string
  place: string
  message: string
}
