"""Finds where each note of a score is heard in a recording."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from reina.music import Score
from reina.sound.alignment.alignment import Alignment
from reina.sound.alignment.assemble import assemble
from reina.sound.alignment.bands import Floats, band_energies, rises, tuning_of
from reina.sound.alignment.chords import ScoreNotes, hear_stretch
from reina.sound.alignment.features import frame_features, pooled, transposed
from reina.sound.alignment.onsets import FRAMES_PER_S as ONSET_FRAMES_PER_S
from reina.sound.alignment.onsets import WINDOW_S as ONSET_WINDOW_S
from reina.sound.alignment.path import Likeness, Path, Rules, best_path
from reina.sound.alignment.score_bands import Times, score_energies
from reina.sound.alignment.segments import (
    BentTime,
    Stretch,
    band_around,
    bend_as_a_whole,
    bend_to,
    stretches_of,
)
from reina.sound.alignment.surroundings import count_in, first_beat_s, sounds_after

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
FEWEST_CHORDS = 2
"""A stretch of fewer notes is taken for chance."""
UNTRANSPOSED_BONUS = 1.1
TRANSPOSITIONS = range(-6, 6)
"""Twelve, as tones of an octave know no more."""

Progress = Callable[[float], None]


def align(samples: Floats, rate: int, score: Score, progress: Progress | None = None) -> Alignment:
    tell = progress or (lambda _: None)
    song_duration_s = len(samples) / rate
    notes = ScoreNotes.of(score)
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
    heard = [hear_stretch(notes, stretch, risen, beats_s, transposition) for stretch in fine]
    heard = [stretch for stretch in heard if len(stretch.chord_s) >= FEWEST_CHORDS]
    if not heard:
        return Alignment.identity(score.duration_s, song_duration_s, is_same_music=False)
    assembled = assemble(
        heard,
        first_onset_s=float(notes.onset_s[0]),
        last_onset_s=float(notes.onset_s[-1]),
        end_s=score.duration_s,
        song_duration_s=song_duration_s,
    )
    found = Alignment(
        assembled.points,
        score.duration_s,
        song_duration_s,
        assembled.gaps,
        transposition=transposition,
        tuning_cents=tuning_cents,
    )
    begins_s, ends_s = found.song_times(float(notes.onset_s[0])), found.ends_s
    counted = count_in(risen, ONSET_FRAMES_PER_S, begins_s, first_beat_s(found.song_times(beats_s)))
    tell(1.0)
    return replace(found, count_in=counted, sounds_after=sounds_after(samples, rate, begins_s, ends_s))


def _score_features(notes: ScoreNotes, onset_s: Times, end_s: Times, duration_s: float) -> Floats:
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
    recording: Floats, notes: ScoreNotes, stretches: list[Stretch], duration_s: float, transposition: int
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
    recording: Floats, notes: ScoreNotes, bent: BentTime, stretches: list[Stretch], transposition: int, frame_s: float
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
