// Written by `make generate` from server/reina/protocol; do not edit. Field names are the wire's.

/** Which state of its show a session is in. */
export interface ShowState {
  /** Rises by one with each edit, undo and redo; counted anew when the server loads the session. */
  readonly revision: number
  /** The show's validator, quotes and all: what If-Match takes. */
  readonly etag: string
  /** How many steps can be taken back. */
  readonly undo: number
  /** How many of those taken back can be done again. */
  readonly redo: number
}

/** What came of an edit, an undo or a redo. */
export interface ShowEdited extends ShowState {
  /** The show as it is now, but for its tracks: title, time, markers. */
  readonly head: ShowHead
  /** The tracks that changed, as the show holds them now; none with Prefer: return=minimal. */
  readonly tracks: readonly ShowTrack[]
  /** Parameters whose tracks are gone. */
  readonly removed: readonly string[]
}

/** Keyframes on the parameters of stage, lights, camera and note blocks. */
export interface ShowDocument {
  /** The address of the JSON Schema, for editors. */
  readonly "$schema"?: string
  /** Of this form of documents. */
  readonly version: 1
  /** What the person calls it. */
  readonly title?: string
  /** What else there is to say. */
  readonly description?: string
  /** The unit of times where a track names no other. Bars are counted by how many have gone by. */
  readonly time?: "seconds" | "beats" | "bars"
  /** Named places. */
  readonly markers?: readonly Marker[]
  /** One a parameter. Tracks of unknown parameters are kept as they came, without effect. */
  readonly tracks: readonly ShowTrack[]
}

/** A track whose curve is asked for; it is not kept. */
export interface CurvePreview {
  /** As a show has it, with its parameter; times without a unit of their own are in the show's. */
  readonly track: ShowTrack
}

/** One keyframe more; a track is made where there is none. */
export interface AddKeyframe {
  readonly edit: "add_keyframe"
  readonly parameter: string
  /** Without a key it gets the next free one. */
  readonly keyframe: NewKeyframe
  /** Whether one that stands at its time gives way, and leaves it its key. */
  readonly replace?: boolean
}

/** Some fields of a keyframe changed; null takes one back to its default. */
export interface ChangeKeyframe {
  readonly edit: "change_keyframe"
  readonly parameter: string
  readonly key: string
  /** Another interpolation drops the old one's options. */
  readonly changes: Readonly<Record<string, unknown>>
}

/** One keyframe less; a track that loses its last and answers no events goes with it. */
export interface RemoveKeyframe {
  readonly edit: "remove_keyframe"
  readonly parameter: string
  readonly key: string
}

/**
 * Keyframes of several tracks moved to about + factor · (time - about) + by.
 *
 * What stands there gives way.
 */
export interface MoveKeyframes {
  readonly edit: "move_keyframes"
  /** Keys by their parameters. */
  readonly keyframes: Readonly<Record<string, readonly string[]>>
  readonly by?: number
  readonly stretch?: Stretch
  /** The unit of by and about; the show's where it is not given. */
  readonly time?: "seconds" | "beats" | "bars"
  /** What is added to the values, held within their range: a number, or three for vectors. */
  readonly value_by?: unknown
}

/** A track in the place of its parameter's own, if there is any. */
export interface PutTrack {
  readonly edit: "put_track"
  readonly track: ShowTrack
}

/** What a track has beside its keyframes, changed. */
export interface ChangeTrack {
  readonly edit: "change_track"
  readonly parameter: string
  readonly changes: TrackChanges
}

/** A track for another parameter of the same type as well; values are held within its range. */
export interface CopyTrack {
  readonly edit: "copy_track"
  readonly parameter: string
  /** The other parameter. */
  readonly to: string
}

/** A track less, of an unknown parameter too. */
export interface RemoveTrack {
  readonly edit: "remove_track"
  readonly parameter: string
}

/** Many parameters given values at once, from a time on or throughout. */
export interface ApplyLook {
  readonly edit: "apply_look"
  readonly look: Look
  /**
   * From when on: what was before stays, and each track goes on to its next keyframe from there. Throughout
   * where it is not given: what the tracks were is gone.
   */
  readonly at?: number
  /** The unit of at; the show's where it is not given. */
  readonly time?: "seconds" | "beats" | "bars"
}

/** What a show has beside its tracks, changed. */
export interface ChangeShow {
  readonly edit: "change_show"
  readonly changes: ShowChanges
}

/**
 * What a track does at events, on top of its keyframes: a swell (amount) or values in turn (cycle).
 *
 * Times are in the track's unit.
 */
export interface EventResponse {
  /** What it answers. */
  readonly on: "notes" | "beats" | "bars"
  /** Which notes count. */
  readonly where?: NoteFilter
  /** Only each such event, from the first: 2 takes every other one. */
  readonly every?: number
  /** From the event until the swell is whole, straight. */
  readonly attack?: number
  /** How long it stays whole. */
  readonly hold?: number
  /** From then until it is gone, fast at first: (1 - x)². */
  readonly decay?: number
  /** The swell's value at its height. */
  readonly amount?: unknown
  /** Whether a note's velocity scales its swell. */
  readonly by_velocity?: boolean
  /**
   * How the swell e, 0..1, is put on the keyframes' value v: replace goes from v to the amount, add is
   * v + e · amount, multiply is v · (1 + e · (amount - 1)), max the greater of v and e · amount.
   */
  readonly blend?: "replace" | "add" | "multiply" | "max"
  /** Values that take turns: the first from the first event on, the second from the second on. */
  readonly cycle?: readonly unknown[]
}

/** Values and movements to put into a show; what a show's parameters do not know of it is left out. */
export interface Look {
  /** By parameter, each as the parameter has it. */
  readonly values?: Readonly<Record<string, unknown>>
  /** Tracks of keyframes without events; their times count from where the look is put. */
  readonly tracks?: readonly ShowTrack[]
  /**
   * Parameters, or beginnings of their paths, that go back to their defaults where they have no value and
   * no track here: lights for all lights.
   */
  readonly rest?: readonly string[]
}

/** A named place, in the show's unit of time. */
export interface Marker {
  /** Where. */
  readonly time: number
  /** What to call it. */
  readonly name: string
}

/** A keyframe to add: without a value it gets the one that the others have at its time. */
export interface NewKeyframe {
  /** Its name within the track; the next free one where it is not given. */
  readonly key?: string
  /** In the track's unit. */
  readonly time: number
  readonly value?: unknown
  /** How to come here from the keyframe before; step where nothing lies between two values. */
  readonly interpolation?: string
  /** The slope with which a spline comes to it, value per unit of time. */
  readonly in_tangent?: number | readonly number[]
  /** The slope with which a spline that ends at the next keyframe leaves it. */
  readonly out_tangent?: number | readonly number[]
  readonly [other: string]: unknown
}

/** Which notes count; what is not given lets all of them through. */
export interface NoteFilter {
  /** Index of the part; notes of a part that is joined to it count too. */
  readonly part?: number
  /** Lowest and highest MIDI number, both counted in. */
  readonly pitch?: readonly number[]
  /** Least and greatest velocity, 0..1. */
  readonly velocity?: readonly number[]
  /** Numbers of valves, from 1; those notes count that press exactly these, none for open notes. */
  readonly valves?: readonly number[]
  /** Pieces of a drum kit, as snare; those notes count that strike one of these. */
  readonly pieces?: readonly string[]
  /** A drummer's hands and feet; those notes count that are struck with one of these. */
  readonly limbs?: readonly ("left_hand" | "right_hand" | "left_foot" | "right_foot")[]
}

/** Fields of a show to change; null takes one back to its default. */
export interface ShowChanges {
  readonly title?: string | null
  readonly description?: string | null
  readonly markers?: readonly Marker[] | null
}

/** What a show has beside its tracks. */
export interface ShowHead {
  /** The address of the JSON Schema, for editors. */
  readonly "$schema"?: string
  /** Of this form of documents. */
  readonly version: 1
  /** What the person calls it. */
  readonly title?: string
  /** What else there is to say. */
  readonly description?: string
  /** The unit of times where a track names no other. Bars are counted by how many have gone by. */
  readonly time?: "seconds" | "beats" | "bars"
  /** Named places. */
  readonly markers?: readonly Marker[]
}

/** A value at a time. Options of its interpolation stand beside its own fields. */
export interface ShowKeyframe {
  /** Its name within the track; the next free one where it is not given. */
  readonly key?: string
  /** In the track's unit. */
  readonly time: number
  /** As its parameter has it. */
  readonly value: unknown
  /** How to come here from the keyframe before; step where nothing lies between two values. */
  readonly interpolation?: string
  /** The slope with which a spline comes to it, value per unit of time. */
  readonly in_tangent?: number | readonly number[]
  /** The slope with which a spline that ends at the next keyframe leaves it. */
  readonly out_tangent?: number | readonly number[]
  readonly [other: string]: unknown
}

/** The keyframes of one parameter, and what it does where there are none. */
export interface ShowTrack {
  /** The parameter's path. */
  readonly parameter: string
  /** The unit of its keyframes' times; the show's where it names none. */
  readonly time?: "seconds" | "beats" | "bars"
  /** What happens before the first keyframe. */
  readonly before?: "hold" | "loop" | "ping_pong" | "extrapolate"
  /** What happens after the last. */
  readonly after?: "hold" | "loop" | "ping_pong" | "extrapolate"
  /** What colours are mixed in. */
  readonly color_space?: "oklab" | "linear"
  /** Whether the show leaves the track out. */
  readonly muted?: boolean
  /** Whether the show leaves out all tracks that are not solo. */
  readonly solo?: boolean
  /** What it does at notes, beats or bars on top of its keyframes; it then needs none. */
  readonly events?: EventResponse
  /** No two at one time, no two of one key. */
  readonly keyframes?: readonly ShowKeyframe[]
}

/** How far times are stretched, and about which. */
export interface Stretch {
  /** What stays where it is. */
  readonly about?: number
  /** Greater than 0; slopes become so much flatter. */
  readonly factor?: number
}

/** Fields of a track to change; null takes one back to its default. */
export interface TrackChanges {
  /** With another unit the keyframes stay where they are in the music, and get other numbers. */
  readonly time?: "seconds" | "beats" | "bars" | null
  readonly before?: "hold" | "loop" | "ping_pong" | "extrapolate" | null
  readonly after?: "hold" | "loop" | "ping_pong" | "extrapolate" | null
  readonly color_space?: "oklab" | "linear" | null
  readonly muted?: boolean | null
  readonly solo?: boolean | null
  readonly events?: EventResponse | null
}

export type Edit =
  | AddKeyframe
  | ChangeKeyframe
  | RemoveKeyframe
  | MoveKeyframes
  | PutTrack
  | ChangeTrack
  | CopyTrack
  | RemoveTrack
  | ApplyLook
  | ChangeShow
