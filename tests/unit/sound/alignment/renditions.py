"""Recordings of the example scores whose true times are known: rendered at other tempos, spoilt and cut."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cache
from typing import TYPE_CHECKING

import midirenderer
import numpy as np

from reina.music import Notes, Score, read_score
from reina.sound.events import SAMPLE_RATE
from reina.sound.font import find_soundfont
from reina.sound.passages import cut_into_passages, write_passage
from reina.sound.plan import plan_sound
from reina.system.resources import bundled, default_data_dir

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Sound = NDArray[np.float32]

RATE = 24_000
"""Of the recordings, samples a second."""
SCORES = bundled("examples") / "scores"
SAME_MUSIC = {"trumpet-duet": "prince-of-denmarks-march"}
"""Scores that are the same music as another."""


@dataclass(frozen=True)
class Rendition:
    """How a score is recorded.

    Attributes:
        score: Name of an example, without its suffix.
        tempo: How long a second of the score lasts: `(mean, depth)`; a depth of 0 is the same everywhere.
        sudden: Whether the tempo jumps every eight seconds of the score and is not bent smoothly.
        lead_in_s: Silence before.
        count_in: How many clicks, one a beat, stand before the first note, within the lead-in.
        tail_s: Applause after.
        noise_db: Level of noise beside that of the music; None without.
        reverberation_s: Time in which it dies away by 60 dB; 0 without.
        programs: What the parts are played with, in their order; their own otherwise.
        without_parts: Which parts of the score are not played.
        transposition: Semitones by which it sounds higher than the score.
        cents: By how much it is tuned higher.
        wrong: Share of the score's notes whose pitch is another than what is played.
        cut: `(from, seconds)`: what is taken out of the recording.
        repeat: `(from, seconds)`: what is heard twice.
        rubato: By how much the tempo wanders from beat to beat, a share; it slows at the end.
        jitter_s: How far each note is from where its beat is, its standard deviation.
        missing: Share of the score's notes that are not played.
        vibrato_cents: By how much all of it goes up and down, 5.5 times a second.
        breath_db: Level of breaths, which end where notes begin, beside that of the music; None without.
        seed: Of all chance.
    """

    score: str
    tempo: tuple[float, float] = (1.0, 0.0)
    sudden: bool = False
    lead_in_s: float = 0.0
    count_in: int = 0
    tail_s: float = 0.0
    noise_db: float | None = None
    reverberation_s: float = 0.0
    programs: tuple[int, ...] = ()
    without_parts: tuple[int, ...] = ()
    transposition: int = 0
    cents: float = 0.0
    wrong: float = 0.0
    cut: tuple[float, float] | None = None
    repeat: tuple[float, float] | None = None
    rubato: float = 0.0
    jitter_s: float = 0.0
    missing: float = 0.0
    vibrato_cents: float = 0.0
    breath_db: float | None = None
    seed: int = 0


@dataclass(frozen=True, eq=False)
class Recording:
    """A rendition, made.

    Attributes:
        score: What it is to be aligned with.
        samples: (F,) float32 at RATE.
        onset_s: (N,) where each note of the score begins in the recording; NaN if it is not heard, or twice.
        beat_s: (N,) the same without what the player is late or early by.
        rendition: What it was made by.
    """

    score: Score
    samples: Sound
    onset_s: Floats
    beat_s: Floats
    rendition: Rendition = field(repr=False)


@cache
def example(name: str) -> Score:
    """An example score."""
    path = next(SCORES.glob(f"{name}.*"))
    return read_score(path.read_bytes(), filename=path.name)


@cache
def record(rendition: Rendition) -> Recording:
    """Make a recording; the same rendition is made once."""
    score = example(rendition.score)
    random = np.random.default_rng(rendition.seed)
    warp_score, warp_song = _tempo_curve(score, rendition, random)
    # Drawn only where they are asked for, so that other renditions stay what they were.
    late_s = random.normal(0, rendition.jitter_s, len(score.notes)) if rendition.jitter_s else 0.0
    heard = ~np.isin(score.notes.part, rendition.without_parts)
    if rendition.missing:
        heard &= random.random(len(score.notes)) >= rendition.missing
    onset_s = np.maximum(np.interp(score.notes.onset_s, warp_score, warp_song) + late_s, 0)
    played = _played(score, rendition, warp_score, warp_song, onset_s, heard)
    slower = 2 ** (rendition.cents / 1200)
    sound = _detuned(render(played), rendition.cents)
    warp_song = warp_song / slower
    if rendition.vibrato_cents:
        sound = _with_vibrato(sound, rendition.vibrato_cents)
    if rendition.breath_db is not None:
        sound = _with_breaths(sound, onset_s[heard] / slower, rendition.breath_db, random)
    if rendition.reverberation_s:
        sound = reverberated(sound, rendition.reverberation_s, random)
    beat_s = np.interp(score.notes.onset_s, warp_score, warp_song)
    late_s = onset_s / slower - beat_s
    onset_s = beat_s
    if rendition.cut is not None:
        begin_s, length_s = rendition.cut
        heard &= (onset_s < begin_s) | (onset_s >= begin_s + length_s)
        onset_s = np.where(onset_s >= begin_s, onset_s - length_s, onset_s)
        sound = _joined(sound[: _at(begin_s)], sound[_at(begin_s + length_s) :])
    if rendition.repeat is not None:
        begin_s, length_s = rendition.repeat
        end_s = begin_s + length_s
        heard &= (onset_s < begin_s) | (onset_s >= end_s)
        onset_s = np.where(onset_s >= end_s, onset_s + length_s, onset_s)
        sound = _joined(sound[: _at(end_s)], sound[_at(begin_s) :])
    first_beat_s = float(np.interp(score.tempo_map.seconds(1.0), warp_score, warp_song))
    sound = _framed(sound, rendition, first_beat_s, random)
    beat_s = np.where(heard, onset_s + rendition.lead_in_s, np.nan)
    written = _with_wrong_notes(score, rendition.wrong, random)
    return Recording(written, sound, beat_s + late_s, beat_s, rendition)


def render(score: Score) -> Sound:
    """A score's sound by Reina's own synthesizer, mono at RATE; sample 0 is the score's time 0."""
    plan = plan_sound(score)
    soundfont = find_soundfont(default_data_dir()).read_bytes()
    passages = cut_into_passages(plan)
    whole = np.zeros(max(passage.start + passage.length for passage in passages), dtype=np.float32)
    for passage in passages:
        wav = midirenderer.render_wave_from(soundfont, write_passage(plan, passage, gain=0.25))
        pairs = np.frombuffer(wav, dtype="<i2", offset=wav.index(b"data") + 8).reshape(-1, 2)
        sound = pairs.mean(axis=1, dtype=np.float32)[: passage.length]
        whole[passage.start : passage.start + len(sound)] += sound
    whole /= np.abs(whole).max()
    taps = np.sinc(np.arange(-16, 17) / 2) * np.hamming(33)
    assert SAMPLE_RATE == 2 * RATE
    return np.convolve(whole, (taps / taps.sum()).astype(np.float32), "same")[::2].astype(np.float32)


def _tempo_curve(score: Score, rendition: Rendition, random: np.random.Generator) -> tuple[Floats, Floats]:
    """The true map: score time and song time, before anything is put before it or cut out of it."""
    mean, depth = rendition.tempo
    times = np.arange(0.0, score.duration_s + 10, 0.05)
    if rendition.sudden:
        jumps = random.uniform(-1, 1, int(times[-1] / 8) + 1)
        rate = mean * (1 + depth * jumps[(times / 8).astype(int)])
    else:
        phases = random.uniform(0, 2 * np.pi, 2)
        bend = 0.6 * np.sin(times / 5 + phases[0]) + 0.4 * np.sin(times / 1.9 + phases[1])
        rate = mean * (1 + depth * bend)
    if rendition.rubato:
        beats = score.tempo_map.beats(times)
        wander = rendition.rubato * random.standard_normal(int(beats[-1]) + 2)
        rate = rate * np.exp(np.interp(beats, np.arange(len(wander)), wander))
        rate = rate * (1 + 0.5 * np.clip((times - score.duration_s + 4) / 4, 0, 1))
    return times, np.concatenate(([0.0], np.cumsum(rate[:-1] * 0.05)))


def _played(
    score: Score,
    rendition: Rendition,
    warp_score: Floats,
    warp_song: Floats,
    onset_s: Floats,
    heard: NDArray[np.bool_],
) -> Score:
    notes, onset_s = score.notes.take(np.flatnonzero(heard)), onset_s[heard]
    end_s = np.maximum(np.interp(notes.end_s, warp_score, warp_song), onset_s + 0.03)
    parts, programs = score.parts, notes.program
    if rendition.programs:
        parts = tuple(
            replace(part, program=program) for part, program in zip(parts, rendition.programs, strict=True)
        )
        programs = np.asarray(rendition.programs)[notes.part]
    moved = Notes.from_columns(
        part=notes.part,
        channel=notes.channel,
        onset_s=onset_s,
        duration_s=end_s - onset_s,
        onset_beats=notes.onset_beats,
        duration_beats=notes.duration_beats,
        sounding_pitch=notes.sounding_pitch + rendition.transposition,
        velocity=notes.velocity,
        program=programs,
    )
    controls = tuple(
        control._replace(onset_s=float(np.interp(control.onset_s, warp_score, warp_song)))
        for control in score.controls
        if control.kind != "program"
    )
    return replace(score, parts=parts, notes=moved, controls=controls, duration_s=float(moved.end_s.max()))


def _with_wrong_notes(score: Score, share: float, random: np.random.Generator) -> Score:
    wrong = random.random(len(score.notes)) < share
    steps = random.integers(1, 6, len(score.notes)) * random.choice((-1, 1), len(score.notes))
    pitches = np.where(wrong, score.notes.sounding_pitch + steps, score.notes.sounding_pitch)
    return replace(score, notes=replace(score.notes, sounding_pitch=pitches.astype(np.int16)))


def _at(second: float) -> int:
    return round(second * RATE)


def _joined(before: Sound, after: Sound) -> Sound:
    """One after the other, faded so that the seam does not click."""
    fade = np.linspace(0, 1, RATE // 200, dtype=np.float32)
    before, after = before.copy(), after.copy()
    before[-len(fade) :] *= fade[::-1]
    after[: len(fade)] *= fade
    return np.concatenate((before, after))


def _detuned(sound: Sound, cents: float) -> Sound:
    if not cents:
        return sound
    step = 2 ** (cents / 1200)
    at = np.arange(0, len(sound) - 1, step)
    return np.interp(at, np.arange(len(sound)), sound).astype(np.float32)


def _with_vibrato(sound: Sound, cents: float) -> Sound:
    """Read now a little faster, now a little slower."""
    times = np.arange(len(sound)) / RATE
    beat = 2 * np.pi * 5.5
    late_s = (2 ** (cents / 1200) - 1) / beat * (1 - np.cos(beat * times))
    return np.interp(times - late_s, times, sound).astype(np.float32)


def _with_breaths(sound: Sound, onset_s: Floats, level_db: float, random: np.random.Generator) -> Sound:
    """Noise that swells up to some of the notes, and hisses on softly beneath them."""
    level = float(np.sqrt(np.mean(sound**2))) * 10 ** (level_db / 20)
    swell = np.linspace(0, 1, RATE // 4) ** 2
    strength = np.full(len(sound), 0.2)
    for onset in random.choice(onset_s, len(onset_s) // 4, replace=False).tolist():
        end = _at(onset)
        begin = max(0, end - len(swell))
        strength[begin:end] = np.maximum(strength[begin:end], swell[len(swell) - (end - begin) :])
    hiss = np.diff(random.standard_normal(len(sound) + 1))
    return (sound + level * strength * hiss).astype(np.float32)


def reverberated(sound: Sound, time_s: float, random: np.random.Generator) -> Sound:
    """Sound in a room in which it dies away by 60 dB in so many seconds."""
    length = _at(time_s)
    tail = random.standard_normal(length) * 10 ** (-3 * np.arange(length) / length)
    tail *= 0.7 / np.sqrt(np.sum(tail**2))
    tail[0] += 1
    size = len(sound) + length
    return np.fft.irfft(np.fft.rfft(sound, size) * np.fft.rfft(tail, size), size).astype(np.float32)


def _framed(sound: Sound, rendition: Rendition, beat_s: float, random: np.random.Generator) -> Sound:
    """What is before the music, after it and beneath it."""
    level = float(np.sqrt(np.mean(sound**2)))
    before = np.zeros(_at(rendition.lead_in_s), dtype=np.float32)
    for click in range(rendition.count_in):
        at = _at(rendition.lead_in_s - beat_s * (rendition.count_in - click))
        length = RATE // 20
        decay = np.exp(-np.arange(length) / (RATE / 100))
        before[at : at + length] += (6 * level * decay * random.standard_normal(length)).astype(np.float32)
    after = np.zeros(_at(rendition.tail_s), dtype=np.float32)
    after += (level * random.standard_normal(len(after))).astype(np.float32)
    whole = np.concatenate((before, sound, after))
    if rendition.noise_db is not None:
        noise = level * 10 ** (rendition.noise_db / 20) * random.standard_normal(len(whole))
        whole = whole + noise.astype(np.float32)
    return whole.astype(np.float32)
