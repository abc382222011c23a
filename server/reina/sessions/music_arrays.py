"""The music as the arrays that keyframes work on: they know no scores."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments import StrikeFingering, ValvesFingering, who_has_tune
from reina.music.arrays import read_only
from reina.show import LIMBS, TimeMap, Triggers
from reina.stage import MusicForm

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments import PlayedPart, TunePassage
    from reina.music import Score
    from reina.music.arrays import BoolArray, FloatArray


def bar_lines_beats(score: Score) -> FloatArray:
    """(B,) where the bars begin, quarter notes, up to the score's end."""
    return score.metre_map.bar_lines(score.duration_beats + 1e-9)


def time_map(score: Score) -> TimeMap:
    """The score's beats and bars, as keyframes count them."""
    return TimeMap(
        beats=score.tempo_map.beats,
        seconds=score.tempo_map.seconds,
        bar_lines_beats=bar_lines_beats(score),
    )


def triggers(score: Score, played: Sequence[PlayedPart]) -> Triggers:
    """All notes of a score as events that tracks may answer, those of the players' lines as they sound.

    Notes that nobody plays on valves are not taken for open ones; those that a drummer does not strike have
    neither piece nor limb.
    """
    notes = score.notes
    joined_to = notes.part.copy()
    pitch = notes.sounding_pitch.copy()
    pressed: dict[int, tuple[int, ...]] = {}
    struck: dict[int, StrikeFingering] = {}
    for one in played:
        line, fingering = one.line, one.fingering
        pitch[line.note_index] = line.sounding_pitch
        for note, played_so in zip(line.note_index.tolist(), fingering.notes, strict=True):
            if isinstance(played_so, ValvesFingering):
                pressed[note] = played_so.valves
            elif isinstance(played_so, StrikeFingering):
                struck[note] = played_so
        joined_to[np.isin(notes.part, one.joined_parts)] = one.part
    columns = max(map(max, filter(None, pressed.values())), default=0)
    valves = np.zeros((len(notes), columns), dtype=np.bool_)
    for note, down in pressed.items():
        valves[note, [valve - 1 for valve in down]] = True
    fingered = np.zeros(len(notes), dtype=np.bool_)
    fingered[list(pressed)] = True
    pieces = tuple(sorted({stroke.piece for stroke in struck.values()}))
    piece, limb = (np.full(len(notes), -1, dtype=np.int8) for _ in range(2))
    for note, stroke in struck.items():
        piece[note] = pieces.index(stroke.piece)
        limb[note] = LIMBS.index(f"{stroke.hand}_hand" if stroke.hand else f"{stroke.foot}_foot")
    return Triggers(
        onset_s=notes.onset_s,
        part=notes.part,
        pitch=read_only(pitch),
        velocity=notes.velocity,
        valves=read_only(valves),
        fingered=read_only(fingered),
        pieces=pieces,
        piece=read_only(piece),
        limb=read_only(limb),
        end_s=score.duration_s,
        joined_to=read_only(joined_to),
    )


def tune_of(score: Score, played: Sequence[PlayedPart]) -> tuple[TunePassage, ...]:
    """Who of several players has the tune when."""
    lines_s = score.tempo_map.seconds(bar_lines_beats(score))
    return who_has_tune(played, lines_s, score.duration_s)


def tune_form(score: Score, played: Sequence[PlayedPart], tune: Sequence[TunePassage]) -> MusicForm:
    """What the tune is like that goes from player to player, and where its phrases and the bars begin."""
    forms = [music_form(score, one) for one in played]
    begins = np.array([passage.start_s for passage in tune])
    leads = np.array([passage.player for passage in tune])

    def has_it(player: int, onset_s: FloatArray) -> BoolArray:
        return leads[np.maximum(np.searchsorted(begins, onset_s, side="right") - 1, 0)] == player

    kept = [has_it(player, form.onset_s) for player, form in enumerate(forms)]
    columns = np.concatenate(
        [
            np.stack([form.onset_s, form.end_s, form.pitch, form.velocity])[:, own]
            for form, own in zip(forms, kept, strict=True)
        ],
        axis=1,
    )
    onset_s, end_s, pitch, velocity = columns[:, np.argsort(columns[0], kind="stable")]
    phrases_s = np.concatenate(
        [form.phrases_s[has_it(player, form.phrases_s[:, 0])] for player, form in enumerate(forms)]
    )
    return replace(
        forms[0],
        onset_s=onset_s,
        end_s=end_s,
        pitch=pitch,
        velocity=velocity,
        phrases_s=phrases_s[np.argsort(phrases_s[:, 0], kind="stable")],
    )


def music_form(score: Score, played: PlayedPart) -> MusicForm:
    """What a player's line is like, and where its phrases and the bars begin."""
    line = played.line
    first = np.flatnonzero(np.diff(line.phrase, prepend=-1))
    last = np.append(first[1:], len(line))[: len(first)] - 1
    return MusicForm(
        onset_s=line.onset_s,
        end_s=line.end_s,
        pitch=line.sounding_pitch.astype(np.float64),
        velocity=line.velocity,
        bar_lines_s=score.tempo_map.seconds(bar_lines_beats(score)),
        duration_s=score.duration_s,
        phrases_s=np.stack([line.onset_s[first], line.end_s[last]], axis=1),
    )
