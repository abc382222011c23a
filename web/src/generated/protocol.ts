// Written by `make generate` from server/reina/protocol; do not edit. Field names are the wire's.

export const PROTOCOL_VERSION = 1
export const SUBPROTOCOL = "reina.v1"
export const HEADER_SIZE = 24

/** Where everything in a frame is; all of it in bytes, all of it little-endian. */
export interface Manifest {
  protocol: "reina.v1"
  /** Frames a second of song time: frame k shows song time k / fps. */
  fps: number
  /** Bytes of one frame, a multiple of 8. */
  frame_size: number
  skeletons: SkeletonManifest[]
  parameters: ParameterManifest[]
}

/**
 * Song time as a function of server time: song_time_s + (t - server_time_s) · rate while playing.
 *
 * A count-in comes before: so many song seconds pass, at the rate, while song time stands.
 */
export interface TransportState {
  playing: boolean
  /** Song time at server_time_s. */
  song_time_s: number
  /** Seconds on the server's monotonic clock, the one that pong answers with. */
  server_time_s: number
  /** Song seconds a second. */
  rate: number
  loop: Loop | null
  /** Song seconds that are still counted in at server_time_s, before song time runs. */
  count_in_s: number
  /** Raised by every play, pause, seek, rate, loop and edit; frames carry it modulo 256. */
  epoch: number
}

/** Which state of its show a session is in. */
export interface ShowState {
  /** Rises by one with each edit, undo and redo; counted anew when the server loads the session. */
  revision: number
  /** The show's validator, quotes and all: what If-Match takes. */
  etag: string
  /** How many steps can be taken back. */
  undo: number
  /** How many of those taken back can be done again. */
  redo: number
}

/** The frames, packed: 60 to a block, which never changes. */
export interface FrameBlocks {
  /** Which state of score, cast and show they are of: 16 hexadecimal digits; a block's header has it. */
  revision: string
  /** Block n stands at {href}/{n}, for any cache to keep; at another origin where there is one for it. */
  href: string
  /** Whether those who ask the stream for packed blocks get them; else they fetch them ahead of time. */
  pushed: boolean
}

/** How far a session's score is in time with its song. */
export interface AlignmentState {
  /**
   * none: the song is rendered from the score, or is M4A or WebM that no page has decoded yet; unlike:
   * it is other music, and both begin at 0.
   */
  status: "none" | "searching" | "found" | "unlike" | "failed"
  /** 0 to 1; 1 once something is known. */
  progress: number
  /** 0 to 1, how sure it is on the whole; null until something is known. */
  confidence: number | null
  /** Why it failed. */
  detail: string | null
}

/** One note of a part, with its fingering where a player plays that part. */
export interface WireNote {
  /** The note's place in the score's table of notes. */
  index: number
  /** Index of its part. */
  part: number
  /** Seconds from the start of the score. */
  onset_s: number
  duration_s: number
  /** Quarter notes from the start of the score. */
  onset_beats: number
  duration_beats: number
  /** MIDI number as it sounds. */
  sounding_pitch: number
  /** MIDI number as a player of the instrument reads it. */
  written_pitch: number
  /** What it is called as it sounds, in the key of the music: F♯4; C4 is 60. */
  sounding_name: string
  /** What it is called in the part of who plays it. */
  written_name: string
  /** 0 to 1. */
  velocity: number
  /** The valves that are down, ascending; [] is open, null is not playable, not played, no valves. */
  valves: number[] | null
  /** How it is played, by the kind of instrument; null where it is not. */
  fingering: ValvesFingering | SlideFingering | StrikeFingering | KeysFingering | null
  /** What a beginner's chart shows for it, null where valves is; where both differ, reason says why. */
  usual_valves: number[] | null
  /** Why it is played so, or why it is not. */
  reason: string
  /** Who plays its part: a place in the cast, 0 being the first; null if nobody does. */
  player: number | null
  /** Whether somebody plays its part; reason says why a note of it is left out. */
  in_played_part: boolean
}

/** One session: a score, its player, its show and its clock. */
export interface Session {
  id: string
  title: string
  /** Whether the list of sessions shows it; otherwise only who has the id can watch. */
  public: boolean
  /** ISO 8601, UTC. */
  created_at: string
  duration_s: number
  instrument: string
  /** The part that the player plays. */
  part: number
  /** Semitones by which the player's part was asked to be moved. */
  transposition: number
  /** Whether the part is taken as notated for the instrument: a B♭ trumpet then sounds a tone lower. */
  written: boolean
  /** Whether the part is moved by the octaves that bring most of its notes into range. */
  octave_fit: boolean
  /** Further parts that the player plays together with it, as if their notes were its own; ascending. */
  joined_parts: number[]
  /** Which of the player's hands leads. */
  handedness: string
  /** Whether no fingering is taken but the usual one of each note. */
  usual_fingerings: boolean
  /** Who plays: a rig with a hold on the instrument. */
  player: string
  /** Who could. */
  players: string[]
  /** Semitones by which the part is played away from the file's pitches: all three together. */
  sounding_transposition: number
  /** Which of the file's sequences is played, counted from 0. */
  sequence: number
  /** How many the file holds: several only in MIDI files of format 2. */
  sequences: number
  parts: PartSummary[]
  /** The parts that the instrument could play, best first. */
  choices: PartChoice[]
  /** Everybody who plays: part, instrument, player and the like beside it are the first one's. */
  cast: CastSummary
  notes: number
  warnings: Warned[]
  /** The warnings as a musician is told of them, after who plays what and why. */
  findings: Finding[]
  song: SongState
  alignment: AlignmentState
  /** Its own, in the order of the choices of player/stance. */
  stances: Stance[]
  /** When it will be ended unless somebody sees it before, ISO 8601, UTC; null unless that is near. */
  ends_at: string | null
  links: SessionLinks
  /** Whether who asks is signed in as the person who made it, and controls it without its token. */
  mine: boolean
}

/** First on every stream: whoever joins late or again needs nothing else. */
export interface Hello extends Manifest {
  type: "hello"
  session: string
  title: string
  /** Song time at which the clock stops: the player has settled, and the song is over. */
  duration_s: number
  links: StreamLinks
  blocks: FrameBlocks
  song: SongState
  alignment: AlignmentState
  transport: TransportState
}

/** The music clock changed: played, paused, sought, another rate or loop, or an edit raised the epoch. */
export interface Transport extends TransportState {
  type: "transport"
}

/** The show was edited; the frames already follow. */
export interface ShowChanged extends ShowState {
  type: "show_changed"
  /** The parameter whose track changed, or null for several or the whole show. */
  path: string | null
  /** The parameters whose tracks changed or are gone, or null when more than tracks changed. */
  paths: string[] | null
}

/** What is played was chosen anew; read the score again, and the song if its href changed. */
export interface ScoreChanged {
  type: "score_changed"
  /** Which of the file's sequences is played, counted from 0. */
  sequence: number
  part: number
  transposition: number
  /** Whether the part is taken as notated for the instrument. */
  written: boolean
  /** Whether the part is moved into range by octaves. */
  octave_fit: boolean
  /** Further parts that the player plays together with it, ascending. */
  joined_parts: number[]
  /** Which of the player's hands leads. */
  handedness: string
  /** Whether no fingering is taken but the usual one of each note. */
  usual_fingerings: boolean
  /** How long the music now lasts. */
  duration_s: number
  song: SongState
}

/**
 * Score, cast or show changed: the frames are of another revision from here on.
 *
 * transport follows; so does hello before it, where frames hold something else.
 */
export interface BlocksChanged extends FrameBlocks {
  type: "blocks_changed"
}

/** The song can be fetched. */
export interface SongReady {
  type: "song_ready"
  song: SongState
}

/**
 * The search for the score in the song went on or came to an end, or somebody put something right.
 *
 * Where it moves the music score_changed comes too.
 */
export interface AlignmentChanged extends AlignmentState {
  type: "alignment_changed"
}

/** A note of the played part begins (or sounds already, after a seek into it). */
export interface NoteOn extends WireNote {
  type: "note_on"
  /** When, in song time. */
  song_time_s: number
}

/** A note of the played part ends (or is cut off by a pause or a seek). */
export interface NoteOff extends WireNote {
  type: "note_off"
  /** When, in song time. */
  song_time_s: number
}

/** The answer to ping. */
export interface Pong {
  type: "pong"
  id: number
  server_time_s: number
}

/** Something a viewer sent could not be used, or something of the session failed. */
export interface StreamError {
  type: "error"
  title: string
  detail: string
}

/** A session as its creator sees it, once. */
export interface CreatedSession extends Session {
  /** What changes the session needs: Authorization: Bearer <control_token>. */
  control_token: string
}

/** Public sessions, newest first. */
export interface SessionList {
  sessions: SessionSummary[]
  /** What the next page is asked for with, as after; null when there are no more. */
  next: string | null
}

/** A session's control token, as it is told once. */
export interface ControlToken {
  control_token: string
}

/** Who asks, and whether the server wants to know. */
export interface SignIn {
  /** Whether only who is signed in may upload. */
  needed: boolean
  /** By what one signs in; null where nobody does. proxy: at the proxy before the server, not here. */
  asks: "password" | "name-and-password" | "proxy" | null
  signed_in: boolean
  /** Who it is; null where that is not known, as where all have one password. */
  name: string | null
  by: "password" | "proxy" | null
}

/** The score, as far as it is drawn and played. */
export interface Score {
  title: string
  duration_s: number
  sequence: number
  part: number
  transposition: number
  written: boolean
  octave_fit: boolean
  /** Further parts that the player plays together with it, ascending. */
  joined_parts: number[]
  handedness: string
  usual_fingerings: boolean
  parts: PartSummary[]
  tempi: Tempo[]
  metres: Metre[]
  keys: MusicKey[]
  bar_lines_s: number[]
  /** By onset; of one part alone with ?part=. */
  notes: WireNote[]
  /** Lines that the file has to be sung, by time. */
  lyrics: LyricLine[]
  /** Names of sections, rehearsal marks, by time. */
  markers: ScoreText[]
  /** Other words that the file has, by time. */
  texts: ScoreText[]
  warnings: Warned[]
}

/** Where a session's score is heard in its song. */
export interface Alignment extends AlignmentState {
  /**
   * Whether the server can look for the score in the song: in M4A and WebM only once song/analysis has
   * had them decoded; there is nothing to look for in what is rendered.
   */
  is_searchable: boolean
  /** Length of the recording; null where the song is rendered, or its length is not known. */
  song_duration_s: number | null
  /** Where music ends with a whole bar, the last is the bar line there. Empty where the song is rendered. */
  bars: AlignedBar[]
  /**
   * What was found and what people put right: a document that can be kept, and put into a session of the
   * same score and song. Null until something is known.
   */
  alignment: AlignmentDocument | null
}

/** Who plays what, in the order of the players, with what else each could play. */
export interface Cast {
  sequence: number
  /** Whether the score itself said who plays; false once somebody has chosen. */
  auto: boolean
  castings: Casting[]
  /** Every other part of the score, in its order. */
  unplayed: UnplayedPart[]
  /** Who is heard above the others, from the beginning to the end: the higher, livelier, louder line. */
  tune: TunePassage[]
}

/** What a cast can be made of. */
export interface InstrumentList {
  instruments: InstrumentSummary[]
  /** Where players can stand; left and right are theirs. */
  seats: string[]
  /** How many play at once at most. */
  max_players: number
}

/** A session's own stances. */
export interface StanceList {
  /** In the order of the choices. */
  stances: Stance[]
}

/** What one player plays, as notation. */
export interface WrittenPart {
  title: string
  part_name: string
  /** A place in the cast, 0 being the first. */
  player: number
  instrument: string
  instrument_title: string
  clef: "treble" | "bass" | "percussion"
  /** Semitones from a pitch that sounds to the one that is written. */
  written_above_sounding: number
  /** Whether swung eighths are written even. */
  swing: boolean
  keys: MusicKey[]
  tempi: PartTempo[]
  /** The line, by onset. */
  notes: PartNote[]
  /** Up to the end of the last note. */
  measures: PartMeasure[]
}

/** What of a show has no effect in the piece that it is put on, and why. Nothing of it is dropped. */
export interface ShowWarnings {
  /** Each with the parameter, or markers, as its place. */
  warnings: Warned[]
}

/** Curves of parameters, sampled at the same times. */
export interface ShowCurves {
  times_s: number[]
  /** In the order in which they were asked for. */
  curves: ShowCurve[]
}

/** The music's time, for rulers, snapping, and the time of a key in its track's unit. */
export interface MusicTime {
  duration_s: number
  knots: TimeKnots
  /** Every beat (quarter note) of the score. */
  beats_s: number[]
  /** Every bar line of the score. */
  bars_s: number[]
  /** Every onset of a note that the player plays, each once. */
  onsets_s: number[]
}

/** The shape of a song's sound: its lowest and highest sample, all channels together, by stretches. */
export interface SongPeaks {
  /** The song's length, which all stretches together fill evenly. */
  duration_s: number
  /** -1..1, a number a stretch. */
  lowest: number[]
  /** -1..1. */
  highest: number[]
  /** False while the song is being rendered: what is missing stands as silence, and comes. */
  complete: boolean
}

/** The bundled shows, each to be fetched and put into a session of one's own. */
export interface ShowLibrary {
  shows: ShowSummary[]
}

/** The rigs that this server has. */
export interface RigList {
  rigs: RigSummary[]
}

/** Every parameter in the frame's order, and every interpolation. */
export interface ShowParameterList {
  /** What a show can move. The first player's paths stand alone, the second's begin with players/2/. */
  parameters: ShowParameter[]
  /** What the players give to a frame beside the show, such as valves; no keyframe moves it. */
  streamed: ShowParameter[]
  interpolations: Interpolation[]
}

/** The bundled pieces; the first is the one for a first visit. */
export interface ExampleList {
  examples: Example[]
}

/** What a file is, by what stands in it. */
export interface FileRole {
  /** As what it can be sent; null: as nothing. */
  role: "score" | "song" | "show" | null
  /** What it is: a MIDI file, a PDF. */
  name: string
  /** What to send in its place; empty where it can be sent. */
  advice: string
}

/** The search for the notes of a recording. Whoever has its id may take what is found, and end it. */
export interface Transcription {
  id: string
  title: string
  status: "searching" | "found" | "failed"
  /** 0..1. */
  progress: number
  /** How many were found. */
  notes: number
  /** Whether they tell a beat; where they do not, 120 a minute are written. */
  has_beat: boolean
  /** Why there is no score: mix, more than one line sounds; other, as detail says. */
  fault: "mix" | "other" | null
  /** The same in words. */
  detail: string | null
  links: TranscriptionLinks
}

/** Lights to choose without programming. */
export interface LightMoodList {
  moods: LightMood[]
}

/** Liveness and readiness. */
export interface Health {
  /** ok while it can play, else not-ready. */
  status: string
  ready: boolean
  /** What keeps it from being ready. */
  not_ready: Unready[]
  version: string
  /** The subprotocols that it speaks. */
  streams: string[]
  server_time_s: number
}

/** Problem details (RFC 9457), sent as application/problem+json. */
export interface Problem {
  type: string
  title: string
  status: number
  detail: string
  /** Each fault, where there are several; else empty. */
  errors: Fault[]
  /** urn:reina:request: and the id of the request, which the server's log has too. */
  instance: string | null
}

/** A viewer measures the offset between its clock and the server's. */
export interface Ping {
  type: "ping"
  id: number
}

/**
 * A viewer wants frames longer before they are due, as behind a network that is slow or loses packets.
 *
 * Some that were sent already may come again.
 */
export interface Lead {
  type: "lead"
  /** How long before they are due frames are sent from now on; 0.1 until it is said. */
  lead_s: number
}

/** Play from where the clock stands (from the start, where it stands at the end). */
export interface Play {
  action: "play"
  /** Song seconds that are counted in before: so long song time stands, at the rate. */
  count_in_s?: number
}

/** Stop, and stay. */
export interface Pause {
  action: "pause"
}

/** Go to a song time, held within the score. */
export interface Seek {
  action: "seek"
  song_time_s: number
}

/** Play faster or slower. */
export interface SetRate {
  action: "rate"
  rate: number
}

/** Loop over a span; both null, or left out, end the loop. */
export interface SetLoop {
  action: "loop"
  start_s?: number | null
  end_s?: number | null
  /** Song seconds that are counted in before each further round. */
  count_in_s?: number
}

/**
 * What PATCH may change of a session; a field left out stays.
 *
 * Of another sequence the best part is played, unless one is named with it. Another part is played alone,
 * unless others are named with it.
 */
export interface SessionChange {
  title?: string | null
  public?: boolean | null
  part?: number | null
  transposition?: number | null
  written?: boolean | null
  octave_fit?: boolean | null
  joined_parts?: number[] | null
  usual_fingerings?: boolean | null
  sequence?: number | null
  player?: string | null
  handedness?: "left" | "right" | null
  /** auto: the score itself says who plays it; the fields for one player are then left out. */
  cast?: "auto" | null
}

/** What somebody signs in by. */
export interface Password {
  /** Whose password it is; where all have one it is left out. */
  name?: string | null
  password: string
}

/** Who is to play what, the first player first. */
export interface CastFields {
  castings: CastingFields[]
  /** Which sequence of a MIDI file of format 2; null leaves it as it is. */
  sequence?: number | null
}

/** What a person puts right in an alignment. */
export interface AlignmentCorrections {
  /** Places of the score that are put where they are heard; what was found goes through them. */
  anchors?: AnchorDocument[]
  /** By how much everything is heard later, seconds. */
  offset_s?: number
  /**
   * Whether all is played in the recording's key, transposition semitones above the score's; else in the
   * score's.
   */
  follows_key?: boolean
}

/** A bar of the score, and where it is heard. */
export interface AlignedBar {
  /** As musicians count: the first whole bar is 1, a pickup before it 0. */
  number: number
  /** 0 to 1, how surely it begins where it is thought to. */
  confidence: number
  /** False where the recording leaves it out. */
  is_heard: boolean
  /** As they are conducted (dotted quarters in 6/8); the first is the bar line. */
  beats: AlignedBeat[]
}

/** A beat of the score, and where it is heard. */
export interface AlignedBeat {
  /** In the score as it is written: what an anchor's score_s is. */
  score_s: number
  song_s: number
}

/** Where each place of a score is heard in a recording, as Alignment. */
export interface AlignmentDocument {
  version?: 1
  points: PointDocument[]
  score_duration_s: number
  song_duration_s: number
  gaps?: GapDocument[]
  is_same_music?: boolean
  transposition?: number
  tuning_cents?: number
  count_in?: number
  sounds_after?: boolean
  anchors?: AnchorDocument[]
  offset_s?: number
  follows_key?: boolean
}

/** A place of the score that a person has put where they hear it, as Anchor. */
export interface AnchorDocument {
  score_s: number
  song_s: number
}

/** Who plays what, in the order of the players, and why nobody plays the rest. */
export interface CastSummary {
  sequence: number
  /** Whether the score itself said who plays; false once somebody has chosen. */
  auto: boolean
  castings: CastingSummary[]
  /** Every other part of the score, in its order. */
  unplayed: UnplayedPart[]
}

/** What a player does, how it came out, and what else there is. */
export interface Casting {
  part: number
  part_name: string
  instrument: string
  player: string
  seat: string
  /** Whether somebody chose the seat; otherwise it is by how many play. */
  seat_chosen: boolean
  transposition: number
  written: boolean
  octave_fit: boolean
  joined_parts: number[]
  handedness: string
  usual_fingerings: boolean
  /** Semitones by which the part is played away from the file's pitches. */
  sounding_transposition: number
  /** How many notes the player plays, one at a time. */
  notes: number
  /** How many of these the instrument has. */
  playable: number
  /** Why this part suits the instrument, or does not. */
  reasons: string[]
  /** Why there is a player for it: what the part is for, and what it is beside the parts of those before. */
  cast_because: string[]
  /** The parts that the instrument could play, best first. */
  choices: PartChoice[]
}

/** What a player is asked to do; a field left out is as it is by default. */
export interface CastingFields {
  /** Index of the part; null: the one that suits the instrument best of those that nobody else plays. */
  part?: number | null
  instrument?: string
  /** Who plays: a rig with a hold on the instrument. */
  player?: string
  /** Where on the stage; null: by how many play. */
  seat?: string | null
  transposition?: number
  written?: boolean
  octave_fit?: boolean
  joined_parts?: number[]
  /** Which hand leads, where the instrument can be played so. */
  handedness?: "left" | "right"
  /** Take no fingering but the usual one of each note. */
  usual_fingerings?: boolean
}

/** What a player does, and how it came out. */
export interface CastingSummary {
  part: number
  part_name: string
  instrument: string
  player: string
  seat: string
  /** Whether somebody chose the seat; otherwise it is by how many play. */
  seat_chosen: boolean
  transposition: number
  written: boolean
  octave_fit: boolean
  joined_parts: number[]
  handedness: string
  usual_fingerings: boolean
  /** Semitones by which the part is played away from the file's pitches. */
  sounding_transposition: number
  /** How many notes the player plays, one at a time. */
  notes: number
  /** How many of these the instrument has. */
  playable: number
  /** Why this part suits the instrument, or does not. */
  reasons: string[]
  /** Why there is a player for it: what the part is for, and what it is beside the parts of those before. */
  cast_because: string[]
}

/** How an instrument plays one note. */
export interface ChartLine {
  sounding_pitch: number
  written_pitch: number
  /** One name, or of a black key both: the sharp, then the flat. */
  sounding_names: string[]
  written_names: string[]
  /** The usual one first, then the alternates; each the valves that are down, ascending. */
  fingerings: number[][]
}

/** A parameter's values over the times of a ShowCurves. */
export interface CurveLine {
  /** A list a component, each as long as times_s: colours linear sRGB, choices indices, as in frames. */
  values: number[][]
  /** Indices i where the value jumps between times_s[i - 1] and times_s[i]; a line is broken there. */
  jumps: number[]
}

/** A bundled piece: its files, to be posted as a session of one's own. */
export interface Example {
  name: string
  title: string
  score: string
  song: string | null
  show: string | null
}

/** One of several things that were wrong. */
export interface Fault {
  detail: string
  /** The place in the input. */
  location: string | null
}

/** What a musician is told of one kind of warning, or of who plays what, counted. */
export interface Finding {
  /** A stable name; with count and values all that another language's words need. */
  kind: string
  /** Who plays what; what became of a part; the score's file; the recording; the show. */
  about: "choice" | "playing" | "file" | "song" | "show"
  /** Music is missing; something was set right; good to know. */
  weight: "cut" | "repaired" | "note"
  /** How many things it is about. */
  count: number
  /** What the words hold beside the count. */
  values: Record<string, string | number>
  /** The words, in English, without a full stop. */
  text: string
  /** The place in the cast of the player whom it concerns; null for nobody. */
  player: number | null
  /** The warnings, one by one; of very many the first. */
  details: Warned[]
}

/** What one of both leaves out, as Gap. */
export interface GapDocument {
  score_from_s: number
  score_to_s: number
  song_from_s: number
  song_to_s: number
}

/** An instrument that somebody can play. */
export interface InstrumentSummary {
  name: string
  title: string
  rig: string
  /** The rigs that hold it. */
  players: string[]
  /** Which hand may lead. */
  handedness: string[]
  /** The clef that it is written in. */
  clef: "treble" | "bass"
  /** How many it has. */
  valves: number
  /** What of it is struck, by name, as the drums of a kit; empty where it is not struck. */
  pieces: string[]
  /** Where it stands by itself: there is room for one of it. null where it stands with the others. */
  seat: string | null
  /** Every note that it has, from the lowest up. */
  chart: ChartLine[]
}

/** A way to come to a keyframe from the one before. */
export interface Interpolation {
  name: string
  documentation: string
  options: InterpolationOption[]
  /** Where its slopes come from, for splines. */
  tangents: string | null
}

/** A number, or several, that a keyframe of an interpolation may set. */
export interface InterpolationOption {
  name: string
  default: number | number[]
  minimum: (number | null)[]
  maximum: (number | null)[]
  documentation: string
}

/** How an instrument with keys or finger holes plays a note. */
export interface KeysFingering {
  type: "keys"
  /** The keys that are down, or the holes that are shut, by name. */
  keys: string[]
}

/** A light to choose; the edit apply_look takes its values and rest. */
export interface LightMood {
  name: string
  title: string
  /** Parameters, each with its value. */
  values: Record<string, number | string | number[]>
  /** Parameters, or beginnings of their paths, that go back to their defaults where they have no value. */
  rest: string[]
}

/** The span of song time that is played over and over. */
export interface Loop {
  start_s: number
  end_s: number
  /** Song seconds that are counted in before each further round, at the rate, at start_s. */
  count_in_s: number
}

/** A line of lyrics. */
export interface LyricLine {
  /** When its first syllable is sung. */
  start_s: number
  /** When the next line begins, or it is over. */
  end_s: number
  syllables: SungSyllable[]
}

/** A time signature and where it begins. */
export interface Metre {
  onset_beats: number
  onset_s: number
  numerator: number
  denominator: number
}

/** A key and where it begins. */
export interface MusicKey {
  onset_beats: number
  onset_s: number
  /** As the first player's part sounds: E♭ major; no key where the notes are in none. */
  name: string
  /** Sharps of its signature; flats are negative. */
  fifths: number
  /** As it stands in the first player's part. */
  written_name: string
  written_fifths: number
  /** Whether the file says it, or it is found from the notes. */
  source: "file" | "notes" | "none"
}

/** One parameter of the frame. */
export interface ParameterManifest {
  path: string
  type: "number" | "boolean" | "choice" | "color" | "vector" | "orientation" | "transform"
  /** Bytes from the frame's start to its value. */
  offset: number
  /** How many float32 the value has. */
  length: number
  /** False: a page never blends it between two frames. */
  blend: boolean
}

/** How well a part suits the player's instrument. */
export interface PartChoice {
  part: number
  score: number
  reasons: string[]
}

/** A note or a rest in a bar. */
export interface PartEntry {
  /** From the bar's beginning; a quarter has 48. */
  begin_ticks: number
  ticks: number
  /** Which part of a whole note is written: 4 for a quarter. */
  value: number
  dots: number
  /** Its place in notes; null for a rest. */
  note: number | null
  /** Whether it is the rest of whole bars. */
  is_bar_rest: boolean
  /** As the player reads it. */
  written: PartPitch | null
  sounding: PartPitch | null
  /** Whether a tie comes from the note before. */
  tied_from: boolean
  /** Whether a tie goes to the next note. */
  tied_to: boolean
  /** Notes of a bar with one number are under one beam. */
  beam: number | null
  /** Entries of a bar with one number are a tuplet: three (or six) in the time of two (or four). */
  tuplet: number | null
  is_staccato: boolean
  /** Before it. */
  graces: PartGrace[]
  /** A trill with this note of notes, which is the upper one. */
  trill: number | null
  /** Of a drum part: hands have stems up, feet stems down, and each alone fills the bar; else null. */
  voice: "hands" | "feet" | null
  /** Of a drum part what is struck, from the lowest up; none for a rest, and in other parts. */
  heads: PartHead[]
}

/** A grace note. */
export interface PartGrace {
  /** Its place in notes. */
  note: number
  written: PartPitch
  sounding: PartPitch
  /** Of a drum part how it is drawn. */
  head: PartHead | null
}

/** One of the hits that stand above one another in a drum part. */
export interface PartHead {
  /** Its place in notes. */
  note: number
  /** Where it stands, as on a treble staff: E4 is the lowest line. */
  letter: "A" | "B" | "C" | "D" | "E" | "F" | "G"
  octave: number
  shape: "plain" | "cross" | "circled_cross" | "diamond" | "triangle" | "slashed"
  /** The sign at it. */
  mark: "accent" | "open" | "half_open" | "closed" | "choke" | null
  /** Whether it stands in brackets. */
  is_ghost: boolean
  /** The letter beneath it; null for a foot. */
  hand: "R" | "L" | null
}

/** A bar, or several of rest as one. */
export interface PartMeasure {
  /** The first whole bar is 1, a pickup 0. */
  number: number
  /** How many bars of rest it stands for, else 1. */
  bars: number
  begin_s: number
  end_s: number
  /** How long each bar is: its entries last together as long. */
  ticks: number
  numerator: number
  denominator: number
  /** Of the signature as it sounds. */
  fifths: number
  /** Of the signature in the player's part. */
  written_fifths: number
  entries: PartEntry[]
}

/** A note of the line that is played. */
export interface PartNote {
  /** Its place in the score's table of notes. */
  index: number
  onset_s: number
  end_s: number
  sounding_name: string
  written_name: string
  /** The valves that are down, ascending; null where it cannot be played. */
  valves: number[] | null
  usual_valves: number[] | null
  reason: string
  /** Of a drum part what is struck: snare, hi_hat. */
  piece: string | null
  /** And with what. */
  limb: "left_hand" | "right_hand" | "left_foot" | "right_foot" | null
}

/** Where a note stands on the staff. */
export interface PartPitch {
  /** For people: F♯5. */
  name: string
  letter: "A" | "B" | "C" | "D" | "E" | "F" | "G"
  octave: number
  /** What is printed before it; null where signature and bar say it already. */
  accidental: "flat" | "natural" | "sharp" | null
}

/** One part of a score. */
export interface PartSummary {
  index: number
  name: string
  /** General MIDI program, 0 to 127, where the file says one. */
  program: number | null
  is_drums: boolean
  /** How many notes it has. */
  notes: number
}

/** A tempo that is printed. */
export interface PartTempo {
  /** Index into measures. */
  measure: number
  /** Where in it. */
  begin_ticks: number
  /** Quarter notes a minute; null where a word stands. */
  bpm: number | null
  /** rit., accel. or nothing. */
  word: string
}

/** A place of the score and where it is heard, as MapPoint. */
export interface PointDocument {
  score_s: number
  song_s: number
  confidence?: number
}

/** A rig in the list. */
export interface RigSummary {
  name: string
  href: string
}

/** Words at a place of the score. */
export interface ScoreText {
  onset_s: number
  onset_beats: number
  text: string
}

/** Everything of a session, and the page that shows it. */
export interface SessionLinks {
  self: string
  page: string
  score: string
  song: string
  show: string
  transport: string
  frames: string
  manifest: string
  stream: string
}

/** A session in the list. */
export interface SessionSummary {
  id: string
  title: string
  created_at: string
  links: SessionLinks
}

/** One parameter's curve, whether its track is muted or not. */
export interface ShowCurve {
  parameter: string
  /** The ETag of the track that it was sampled from; "none" where there is none, and of a preview. */
  etag: string
  /** Song time of each of the track's keyframes, in their order, those out of sight included. */
  keys_s: number[]
  /** What the keyframes alone say; the default where there are none. */
  keys: CurveLine
  /** What comes of it with the track's answer to events, where it has one. */
  with_events: CurveLine | null
}

/** A parameter that keyframes can move. */
export interface ShowParameter {
  path: string
  type: "number" | "boolean" | "choice" | "color" | "vector" | "orientation" | "transform"
  unit: string
  minimum: number | null
  maximum: number | null
  default: unknown
  choices: string[]
  /** How many floats it is in a frame. */
  length: number
  blend: boolean
  /** What its keyframes may name. */
  interpolations: string[]
  documentation: string
}

/** A show in the library. */
export interface ShowSummary {
  name: string
  title: string
  description: string
  href: string
}

/** One skeleton of the frame. */
export interface SkeletonManifest {
  /** player or the instrument's name; another player's begin with players/2/. */
  name: string
  /** Whose it is: a place in the cast, 0 being the first. */
  player: number
  /** The rig's name: its joints' rest pose and models stand at the link rigs[rig]. */
  rig: string
  /** Joint names, parents before children; the first is the root. */
  joints: string[]
  /** Bytes from the frame's start to its joint quaternions, x y z w as float32, in the order of joints. */
  offset: number
  /** Bytes from the frame's start to its root's position, x y z as float32, metres. */
  root_offset: number
}

/** How an instrument with a slide plays a note. */
export interface SlideFingering {
  type: "slide"
  /** The position's name: 1 is in. */
  position: string
  /** How far the slide is out, metres. */
  extension_m: number
}

/** A rendered song in segments of one length, each of which can be had as soon as it is rendered. */
export interface SongSegments {
  /** A segment stands at {href}/{number}, from 0 on, and never changes. */
  href: string
  media_type: string
  count: number
  /** Segment n begins at n times this song time; the last is shorter. */
  segment_s: number
  /** How much each holds beside: of the sound before it, and again of the sound after it. */
  overlap_s: number
  /** How long the whole lasts. */
  song_s: number
}

/** The sound that goes with the score. */
export interface SongState {
  /** Another one whenever the sound is another: what was fetched from it before may be kept. */
  href: string
  /** rendering: the server is still making it from the score; song_ready follows. */
  status: "ready" | "rendering" | "failed"
  source: "uploaded" | "rendered"
  media_type: string
  /** 0 to 1; 1 once it is ready. */
  progress: number
  /** Null for an uploaded song, and until a rendered one is planned. */
  segments: SongSegments | null
}

/** A pose of a motion file that a session's players can stand in. */
export interface Stance {
  /** What the show's player/stance chooses it by. */
  name: string
  /** What its sender called the motion file. */
  file: string | null
  /** Of which of its frames the pose is. */
  time_s: number
  /** Where it is taken away. */
  href: string
}

/** Where a viewer finds what the stream does not carry. */
export interface StreamLinks {
  session: string
  score: string
  show: string
  song: string
  /** Rig name to its description. */
  rigs: Record<string, string>
}

/** How percussion plays a note: with a hand or with a foot; the other is null. */
export interface StrikeFingering {
  type: "strike"
  hand: "left" | "right" | null
  foot: "left" | "right" | null
  /** What is struck: a piece that the instrument's rig names. */
  piece: string
  /** Where on the piece. */
  zone: string
}

/** A syllable, and when it is sung. */
export interface SungSyllable {
  onset_s: number
  /** With the blank after it, or before it, that stands between words. */
  text: string
}

/** A tempo and where it begins. */
export interface Tempo {
  onset_beats: number
  onset_s: number
  /** Quarter notes a minute. */
  bpm: number
}

/** Places of the music's time in all three units: between two, and beyond both ends, it runs straight. */
export interface TimeKnots {
  seconds: number[]
  beats: number[]
  bars: number[]
}

/** Where the search for a recording's notes is, and what came of it. */
export interface TranscriptionLinks {
  self: string
  /** The score as a MIDI file, once it is found. */
  midi: string
}

/** A stretch in which one player has the tune. */
export interface TunePassage {
  start_s: number
  /** Where the next begins. */
  end_s: number
  /** The player's place in the cast. */
  player: number
}

/** A part that nobody plays; it is heard. */
export interface UnplayedPart {
  part: number
  part_name: string
  reason: string
}

/** One thing without which the server is not ready. */
export interface Unready {
  reason: "starting" | "data-directory" | "data-full" | "database" | "bus" | "workers" | "soundfont" | "page" | "event-loop" | "ending"
  detail: string
}

/** How valved brass plays a note. */
export interface ValvesFingering {
  type: "valves"
  /** The valves that are down, ascending; [] is open. */
  valves: number[]
}

/** Something in a file that could not be taken as it stands, and what was done instead. */
export interface Warned {
  kind: string
  place: string
  message: string
}

export type ServerMessage =
  | Hello
  | Transport
  | ShowChanged
  | ScoreChanged
  | BlocksChanged
  | SongReady
  | AlignmentChanged
  | NoteOn
  | NoteOff
  | Pong
  | StreamError

export type ViewerMessage =
  | Ping
  | Lead

export type TransportCommand =
  | Play
  | Pause
  | Seek
  | SetRate
  | SetLoop
