"""Finds where each note of a score is heard in a recording."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reina.music import Score
from reina.sound.alignment.alignment import Alignment, Gap, MapPoint
from reina.sound.alignment.bands import Floats, band_energies, rises, tuning_of
from reina.sound.alignment.beats import fit_beats
from reina.sound.alignment.features import frame_features, pooled, transposed
from reina.sound.alignment.onsets import FRAMES_PER_S as ONSET_FRAMES_PER_S
from reina.sound.alignment.onsets import WINDOW_S as ONSET_WINDOW_S
from reina.sound.alignment.onsets import chords_of, refine_onsets
from reina.sound.alignment.path import Likeness, Path, Rules, best_path
from reina.sound.alignment.score_bands import Times, score_energies
from reina.sound.alignment.segments import BentTime, Stretch, band_around, bend_as_a_whole, bend_to, stretches_of

FRAMES_PER_S = 50
WINDOW_S = 0.17
COARSE_FRAMES = 10
"""So many frames are one where the whole is looked at: a fifth of a second."""
MOST_COARSE = 4000
REACH_S = 1.0
COARSE_THRESHOLD = FINE_THRESHOLD = 0.7
COARSE_COSTS = (0.1, 0.0, 0.1, 0.3)
STEADY_FRAMES = 5
STEADY_COSTS = (0.35, 0.0, 0.35, 1.0)
FINE_COSTS = (0.4, 0.0, 0.4, 1.2)
GAP_S = 2.0
"""A gap costs what so many seconds of music earn."""
UNTRANSPOSED_BONUS = 1.1
TRANSPOSITIONS = range(-6, 6)
"""Twelve, as tones of an octave know no more."""

Progress = Callable[[float], None]


@dataclass(frozen=True, eq=False)
class Tones:
    """The notes of a score that have a pitch, and where drums are struck."""

    onset_s: Times
    end_s: Times
    pitch: NDArray[np.int64]
    velocity: Times
    is_drum: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class _Heard:
    """Chords of a stretch and where they are heard."""

    onset_s: Times
    heard_s: Times
    clarity: Times
    knots: Times
    line: Times


def align(samples: Floats, rate: int, score: Score, progress: Progress | None = None) -> Alignment:
    tell = progress or (lambda _: None)
    song_duration_s = len(samples) / rate
    notes = _tones(score)
    tuning_cents = tuning_of(samples, rate)
    tell(0.05)
    energies = band_energies(
        samples, rate, frames_per_s=FRAMES_PER_S, window_s=WINDOW_S, tuning_cents=tuning_cents
    )
    recording = frame_features(energies, rises(energies), FRAMES_PER_S)
    tell(0.25)
    plain = _score_features(notes, notes.onset_s, notes.end_s, score.duration_s)
    transposition, path, frame_s = _whole(recording, plain, tell)
    stretches = stretches_of(path, frame_s, centred=True)
    if not stretches:
        return Alignment.identity(score.duration_s, song_duration_s, is_same_music=False)
    stretches, frame_s = _steadier(recording, notes, stretches, score.duration_s, transposition)
    if not stretches:
        return Alignment.identity(score.duration_s, song_duration_s, is_same_music=False)
    bent = bend_to(stretches, score.duration_s)
    fine = _fine(recording, notes, bent, stretches, transposition, frame_s)
    tell(0.6)
    if not fine:
        return Alignment.identity(score.duration_s, song_duration_s, is_same_music=False)
    sharp = band_energies(
        samples,
        rate,
        frames_per_s=ONSET_FRAMES_PER_S,
        window_s=ONSET_WINDOW_S,
        tuning_cents=tuning_cents,
    )
    risen = rises(sharp)
    tell(0.85)
    beats_s = score.tempo_map.seconds(np.arange(0.0, np.ceil(score.duration_beats) + 1))
    heard = [_place(notes, stretch, risen, transposition, beats_s) for stretch in fine]
    tell(0.95)
    return _map(score, song_duration_s, fine, heard, transposition, tuning_cents)


def _tones(score: Score) -> Tones:
    notes = score.notes
    drums = [part.index for part in score.parts if part.is_drums]
    return Tones(
        notes.onset_s, notes.end_s, notes.sounding_pitch.astype(np.int64), notes.velocity, np.isin(notes.part, drums)
    )


def _score_features(notes: Tones, onset_s: Times, end_s: Times, duration_s: float) -> Floats:
    tones = ~notes.is_drum
    energies, risen = score_energies(
        onset_s[tones],
        end_s[tones],
        notes.pitch[tones],
        notes.velocity[tones],
        frames_per_s=FRAMES_PER_S,
        frames=int(duration_s * FRAMES_PER_S) + 2,
    )
    return frame_features(energies, risen, FRAMES_PER_S)


def _whole(recording: Floats, score: Floats, tell: Progress) -> tuple[int, Path, float]:
    """The best way through the whole, by fifths of a second, in the key in which it earns most."""
    count = max(COARSE_FRAMES, -(-max(len(recording), len(score)) // MOST_COARSE))
    frame_s = count / FRAMES_PER_S
    coarse_recording, coarse_score = pooled(recording, count), pooled(score, count)
    rules = Rules(COARSE_COSTS, GAP_S / frame_s)
    best: tuple[float, int, Path] | None = None
    for number, semitones in enumerate(TRANSPOSITIONS):
        moved = transposed(coarse_score, semitones)
        likeness = Likeness.by_chance(coarse_recording, moved, COARSE_THRESHOLD)
        path = best_path(coarse_recording, moved, likeness, rules)
        value = path.reward * (UNTRANSPOSED_BONUS if semitones == 0 else 1)
        if best is None or value > best[0]:
            best = value, semitones, path
        tell(0.25 + 0.2 * (number + 1) / len(TRANSPOSITIONS))
    assert best is not None
    return best[1], best[2], frame_s


def _steadier(
    recording: Floats, notes: Tones, stretches: list[Stretch], duration_s: float, transposition: int
) -> tuple[list[Stretch], float]:
    """The way through the whole anew, by shorter frames, the score at the recording's tempo as a whole.

    Another tempo than that of the whole then has its price, so that what is repeated is not played at half
    the tempo instead.
    """
    bent = bend_as_a_whole(stretches, duration_s)
    bent_score = transposed(
        _score_features(notes, bent.bend(notes.onset_s), bent.bend(notes.end_s), float(bent.bent_s[-1])),
        transposition,
    )
    count = max(STEADY_FRAMES, -(-max(len(recording), len(bent_score)) // MOST_COARSE))
    frame_s = count / FRAMES_PER_S
    coarse_recording, coarse_score = pooled(recording, count), pooled(bent_score, count)
    likeness = Likeness.by_chance(coarse_recording, coarse_score, COARSE_THRESHOLD)
    path = best_path(coarse_recording, coarse_score, likeness, Rules(STEADY_COSTS, GAP_S / frame_s))
    found = stretches_of(path, frame_s, centred=True)
    return [Stretch(stretch.song_s, bent.straighten(stretch.score_s)) for stretch in found], frame_s


def _fine(
    recording: Floats, notes: Tones, bent: BentTime, stretches: list[Stretch], transposition: int, frame_s: float
) -> list[Stretch]:
    """The way anew, by frames, near where it was found; in the score's time."""
    bent_score = transposed(
        _score_features(notes, bent.bend(notes.onset_s), bent.bend(notes.end_s), float(bent.bent_s[-1])),
        transposition,
    )
    band = band_around(
        stretches,
        bent,
        rows=len(recording),
        columns=len(bent_score),
        frames_per_s=FRAMES_PER_S,
        reach_s=max(REACH_S, 5 * frame_s),
    )
    likeness = Likeness.by_chance(recording, bent_score, FINE_THRESHOLD)
    path = best_path(recording, bent_score, likeness, Rules(FINE_COSTS, GAP_S * FRAMES_PER_S), band)
    found = stretches_of(path, 1 / FRAMES_PER_S, centred=False)
    return [Stretch(stretch.song_s, bent.straighten(stretch.score_s)) for stretch in found]


def _place(notes: Tones, stretch: Stretch, risen: Floats, transposition: int, beats_s: Times) -> _Heard:
    """The chords of a stretch, each where it begins in the recording."""
    begin, end = float(stretch.score_s[0]), float(stretch.score_s[-1])
    inner = beats_s[(beats_s > begin + 0.02) & (beats_s < end - 0.02)]
    knots = np.concatenate(([begin], inner, [end]))
    slack = 1.5 / FRAMES_PER_S
    inside = np.flatnonzero(
        (notes.onset_s >= stretch.score_s[0] - slack) & (notes.onset_s <= stretch.score_s[-1] + slack)
    )
    onset_s = notes.onset_s[inside]
    group, firsts = chords_of(onset_s)
    chord_s = onset_s[firsts]
    pitches: list[NDArray[np.int64]] = []
    unpitched = np.zeros(len(firsts), dtype=np.bool_)
    ends = np.append(firsts[1:], len(onset_s))
    for chord, (first, end) in enumerate(zip(firsts.tolist(), ends.tolist(), strict=True)):
        members = inside[first:end]
        drums = notes.is_drum[members]
        unpitched[chord] = bool(drums.any())
        pitches.append(notes.pitch[members][~drums] + transposition)
    places, first_at = np.unique(stretch.score_s, return_index=True)
    line = np.interp(knots, places, stretch.song_s[first_at])
    heard_s = clarity = chord_s
    for _ in range(2):
        expected_s = np.interp(chord_s, knots, line)
        heard_s, clarity = refine_onsets(risen, expected_s, pitches, unpitched)
        line = fit_beats(knots, chord_s, heard_s, clarity)
    return _Heard(chord_s, heard_s, clarity, knots, line)


def _map(
    score: Score,
    song_duration_s: float,
    stretches: list[Stretch],
    heard: list[_Heard],
    transposition: int,
    tuning_cents: float,
) -> Alignment:
    points: list[MapPoint] = []
    for h in heard:
        points += [MapPoint(a, b, 1.0) for a, b in zip(h.knots.tolist(), np.clip(h.line, 0, song_duration_s).tolist(), strict=True)]
    out: list[MapPoint] = []
    gaps: list[Gap] = []
    for p in points:
        if out:
            b = out[-1]
            p = MapPoint(max(p.score_s, b.score_s), max(p.song_s, b.song_s), p.confidence)
        out.append(p)
    return Alignment(tuple(out), score.duration_s, song_duration_s, tuple(gaps), transposition=transposition, tuning_cents=tuning_cents)
