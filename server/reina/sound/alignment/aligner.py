"""Finds where each note of a score is heard in a recording. docs/alignment.md says how."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from reina.errors import InputError
from reina.music import Score
from reina.sound.alignment.alignment import Alignment
from reina.sound.alignment.assemble import assemble
from reina.sound.alignment.bands import Floats, band_energies, rises, tuning_of
from reina.sound.alignment.chords import HeardStretch, ScoreNotes, hear_stretch, some_parts
from reina.sound.alignment.features import frame_features, pooled, transposed
from reina.sound.alignment.onsets import FRAMES_PER_S as ONSET_FRAMES_PER_S
from reina.sound.alignment.onsets import WINDOW_S as ONSET_WINDOW_S
from reina.sound.alignment.onsets import scaled_rises
from reina.sound.alignment.path import Likeness, Path, Rules, best_path
from reina.sound.alignment.sameness import LEAST, earned_share, sameness
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
COARSE_FRAMES, STEADY_FRAMES = 10, 5
"""So many frames are one where the whole is looked at: 0.2 s in any key, then 0.1 s in the right one."""
MOST_FRAMES = 4000
"""More than so many are not compared all with all; of a long piece each is longer."""
THRESHOLD = 0.7
COARSE_COSTS = (0.1, 0.0, 0.1, 0.3)
STEADY_COSTS = (0.35, 0.0, 0.35, 1.0)
FINE_COSTS = (0.4, 0.0, 0.4, 1.2)
"""The first search is to find any tempo; the later ones have the score at the recording's."""
GAP_S = 2.0
"""A gap costs what so many seconds of music earn."""
REACH_S, REACH_FRAMES = 1.0, 5
"""How far from the coarse path the fine one is looked for: so long, or so many frames of the coarse one."""
TRANSPOSITIONS = range(-6, 6)
"""All keys: twelve, as the tones of an octave know no more."""
UNTRANSPOSED_BONUS = 1.06
"""The score's own key is taken unless another is better by more: a scale is like itself in every key."""
CLOSE_KEYS, MOST_KEYS = 0.85, 4
"""Keys that earn at least such a share of the best are followed more closely, so many at most."""
FEWEST_CHORDS = 2
"""A stretch of fewer notes is taken for chance."""

LONGEST_S = 4200.0
"""A longer recording takes more memory than the process that listens to it may have."""
DOUBTFUL = 0.62
"""Where it is less sure, part of the parts may be missing: some are listened for without the others."""
CLEARLY, LEAST_OF_SOME = 0.1, 0.36
"""By how much more sameness these must have to be taken, and how much at least: few notes are like many."""

Progress = Callable[[float], None]
"""Is told the share of the work that is done, 0..1, rising."""


@dataclass(frozen=True, eq=False)
class _Whole:
    """What the first look at the whole says.

    Attributes:
        in_keys: What goes together in the keys in which most is earned, by transposition, the best first.
        in_all_keys: What a path earns in each key.
    """

    in_keys: dict[int, list[Stretch]]
    in_all_keys: list[float]


@dataclass(frozen=True, eq=False)
class _Followed:
    """A path by frames, cut into stretches, in the score's time.

    Attributes:
        transposition: The key in which it was looked for.
        stretches: The path.
        earned: What it earns.
        frame_s: How long its frames are.
    """

    transposition: int
    stretches: list[Stretch]
    earned: float
    frame_s: float


@dataclass(frozen=True, eq=False)
class _Listened:
    """What a recording sounds like.

    Attributes:
        features: Of its frames.
        scaled: (F, BANDS) where something begins, at the onsets' frames, as `scaled_rises` says.
        broad: (F,) by how much all bands together rise there.
        tuning_cents: By how much it is tuned higher.
    """

    features: Floats
    scaled: Floats
    broad: Floats
    tuning_cents: float


@dataclass(frozen=True, eq=False)
class _Found:
    """Where notes are heard.

    Attributes:
        transposition: Semitones by which they sound higher.
        heard: The stretches of the score that are heard.
        confidence: How clearly they begin where they are thought to, 0..1.
        sameness: Of `sameness.sameness`.
    """

    transposition: int
    heard: list[HeardStretch]
    confidence: float
    sameness: float


def align(samples: Floats, rate: int, score: Score, progress: Progress | None = None) -> Alignment:
    """Find where a score is heard in a recording.

    Args:
        samples: (S,) the recording, mono; 20,000 to 48,000 samples a second tell enough.
        rate: Samples a second.
        score: What is played in it.
        progress: Is told how far the work is.

    Raises:
        InputError: The recording is longer than `LONGEST_S`.
    """
    tell = progress or _tell_nobody
    song_duration_s = len(samples) / rate
    if song_duration_s > LONGEST_S:
        raise InputError(
            f"the recording lasts {song_duration_s / 60:.0f} minutes, and in {LONGEST_S / 60:.0f} at most "
            "the score is looked for: cut it, or put them in time by hand"
        )
    unlike = Alignment.identity(score.duration_s, song_duration_s, is_same_music=False)
    if not np.any(samples):
        return unlike
    notes = ScoreNotes.of(score)
    listened = _listen(samples, rate, tell)
    beats_s = score.tempo_map.seconds(np.arange(0.0, np.ceil(score.duration_beats) + 1))
    found = _find(listened, notes, score.duration_s, beats_s, lambda share: tell(0.5 + 0.3 * share))
    others = some_parts(notes) if found is None or found.confidence < DOUBTFUL else []
    for number, some in enumerate(others):
        begin = 0.8 + 0.15 * number / len(others)
        other = _find(listened, some, score.duration_s, beats_s, _share_of(tell, begin, 0.15 / len(others)))
        least = LEAST_OF_SOME if found is None else max(LEAST_OF_SOME, found.sameness + CLEARLY)
        if other is not None and other.sameness > least:
            found = other
    tell(0.95)
    if found is None or found.sameness < LEAST:
        return unlike
    alignment = replace(
        _put_together(found.heard, notes, score.duration_s, song_duration_s),
        transposition=found.transposition,
        tuning_cents=round(listened.tuning_cents, 1),
    )
    begins_s = alignment.song_times(float(notes.onset_s[0]))
    first_s = first_beat_s(alignment.song_times(beats_s))
    counted = count_in(listened.broad, ONSET_FRAMES_PER_S, begins_s, first_s)
    applause = sounds_after(samples, rate, begins_s, alignment.ends_s)
    tell(1.0)
    return replace(alignment, count_in=counted, sounds_after=applause)


def _listen(samples: Floats, rate: int, tell: Progress) -> _Listened:
    tuning_cents = tuning_of(samples, rate)
    tell(0.05)
    energies = band_energies(
        samples, rate, frames_per_s=FRAMES_PER_S, window_s=WINDOW_S, tuning_cents=tuning_cents
    )
    features = frame_features(energies, rises(energies), FRAMES_PER_S)
    tell(0.2)
    sharp = band_energies(
        samples,
        rate,
        frames_per_s=ONSET_FRAMES_PER_S,
        window_s=ONSET_WINDOW_S,
        tuning_cents=tuning_cents,
    )
    tell(0.45)
    risen = rises(sharp)
    broad = risen.mean(axis=1)
    return _Listened(features, scaled_rises(risen), broad, tuning_cents)


def _find(
    listened: _Listened, notes: ScoreNotes, duration_s: float, beats_s: Times, tell: Progress
) -> _Found | None:
    """Where notes are heard; None where nothing goes together."""
    recording = listened.features
    whole = _look_at_whole(recording, notes, duration_s, lambda share: tell(0.5 * share))
    steady = _follow_steadily(recording, notes, whole, duration_s)
    tell(0.7)
    if steady is None or not steady.stretches:
        return None
    fine = _follow_finely(recording, notes, steady, duration_s)
    tell(0.8)
    heard = [
        hear_stretch(notes, stretch, listened.scaled, beats_s, fine.transposition)
        for stretch in fine.stretches
    ]
    heard = [stretch for stretch in heard if len(stretch.chord_s) >= FEWEST_CHORDS]
    tell(1.0)
    if not heard:
        return None
    confidence = float(np.mean(np.concatenate([stretch.agreement for stretch in heard])))
    same = sameness(fine.earned, whole.in_all_keys, confidence)
    return _Found(fine.transposition, heard, confidence, same)


def _share_of(tell: Progress, begin: float, length: float) -> Progress:
    return lambda share: tell(begin + length * share)


def _tell_nobody(_: float) -> None:
    pass


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


def _bent_features(notes: ScoreNotes, bent: BentTime, transposition: int) -> Floats:
    onset_s, end_s = bent.bend(notes.onset_s), bent.bend(notes.end_s)
    return transposed(_score_features(notes, onset_s, end_s, float(bent.bent_s[-1])), transposition)


def _frames_in_one(usual: int, *features: Floats) -> int:
    return max(usual, *(-(-len(each) // MOST_FRAMES) for each in features))


def _look_at_whole(recording: Floats, notes: ScoreNotes, duration_s: float, tell: Progress) -> _Whole:
    """The best way through all of both, in each of the keys in which it earns most."""
    score = _score_features(notes, notes.onset_s, notes.end_s, duration_s)
    count = _frames_in_one(COARSE_FRAMES, recording, score)
    frame_s = count / FRAMES_PER_S
    coarse_recording, coarse_score = pooled(recording, count), pooled(score, count)
    rules = Rules(COARSE_COSTS, GAP_S / frame_s)
    paths: list[Path] = []
    earned: list[float] = []
    for semitones in TRANSPOSITIONS:
        moved = transposed(coarse_score, semitones)
        likeness = Likeness.by_chance(coarse_recording, moved, THRESHOLD)
        paths.append(best_path(coarse_recording, moved, likeness, rules))
        earned.append(earned_share(paths[-1], coarse_recording, moved))
        tell(len(paths) / len(TRANSPOSITIONS))
    valued = [_value(share, semitones) for semitones, share in zip(TRANSPOSITIONS, earned, strict=True)]
    best = sorted(range(len(paths)), key=lambda key: -valued[key])[:MOST_KEYS]
    close = [key for key in best if valued[key] >= CLOSE_KEYS * valued[best[0]]]
    in_keys = {TRANSPOSITIONS[key]: stretches_of(paths[key], frame_s, centred=True) for key in close}
    return _Whole(in_keys, earned)


def _value(earned: float, transposition: int) -> float:
    return earned * (UNTRANSPOSED_BONUS if transposition == 0 else 1)


def _follow_steadily(
    recording: Floats, notes: ScoreNotes, whole: _Whole, duration_s: float
) -> _Followed | None:
    """The way through all of both anew, the score at the recording's tempo as a whole; None if there is none.

    Another tempo than that then has its price: what the recording repeats is a gap, and not the music at half
    its tempo. Of several keys that were about as good, the one that is taken is the best now.
    """
    followed = [
        _follow_in_key(recording, notes, stretches, semitones, duration_s)
        for semitones, stretches in whole.in_keys.items()
        if stretches
    ]
    return max(followed, key=lambda each: _value(each.earned, each.transposition), default=None)


def _follow_in_key(
    recording: Floats, notes: ScoreNotes, found: list[Stretch], transposition: int, duration_s: float
) -> _Followed:
    bent = bend_as_a_whole(found, duration_s)
    score = _bent_features(notes, bent, transposition)
    count = _frames_in_one(STEADY_FRAMES, recording, score)
    frame_s = count / FRAMES_PER_S
    coarse_recording, coarse_score = pooled(recording, count), pooled(score, count)
    likeness = Likeness.by_chance(coarse_recording, coarse_score, THRESHOLD)
    path = best_path(coarse_recording, coarse_score, likeness, Rules(STEADY_COSTS, GAP_S / frame_s))
    stretches = [stretch.straightened(bent) for stretch in stretches_of(path, frame_s, centred=True)]
    earned = earned_share(path, coarse_recording, coarse_score)
    return _Followed(transposition, stretches, earned, frame_s)


def _follow_finely(recording: Floats, notes: ScoreNotes, steady: _Followed, duration_s: float) -> _Followed:
    """The way by single frames, near where it was found, the score at the recording's tempo everywhere."""
    bent = bend_to(steady.stretches, duration_s)
    score = _bent_features(notes, bent, steady.transposition)
    band = band_around(
        steady.stretches,
        bent,
        rows=len(recording),
        columns=len(score),
        frames_per_s=FRAMES_PER_S,
        reach_s=max(REACH_S, REACH_FRAMES * steady.frame_s),
    )
    likeness = Likeness.by_chance(recording, score, THRESHOLD)
    path = best_path(recording, score, likeness, Rules(FINE_COSTS, GAP_S * FRAMES_PER_S), band)
    frame_s = 1 / FRAMES_PER_S
    stretches = [stretch.straightened(bent) for stretch in stretches_of(path, frame_s, centred=False)]
    return _Followed(steady.transposition, stretches, earned_share(path, recording, score), frame_s)


def _put_together(
    heard: list[HeardStretch], notes: ScoreNotes, duration_s: float, song_duration_s: float
) -> Alignment:
    tones_s = notes.onset_s[~notes.is_drum]
    assembled = assemble(
        heard,
        first_onset_s=float(notes.onset_s[0]),
        last_onset_s=float(notes.onset_s[-1]),
        end_s=duration_s,
        song_duration_s=song_duration_s,
        tones_s=(float(tones_s[0]), float(tones_s[-1])) if notes.is_drum.any() and len(tones_s) else None,
    )
    return Alignment(assembled.points, duration_s, song_duration_s, assembled.gaps)
