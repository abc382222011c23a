from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.unit.stage.framing import VALVES, furthest_out

from reina.show import Show, TimeMap
from reina.stage import MusicForm, stage_registry, write_default_show
from reina.stage.music_form import LONGEST_S, SHORTEST_S, passages
from reina.stage.shot_choice import Piece
from reina.stage.shots import SHOTS

REGISTRY = stage_registry()
BAR_S = 2.0


def _form(notes: list[tuple[float, float, float, float]], bars: int, **fields: Any) -> MusicForm:
    """A form of notes (onset, end, pitch, velocity) in bars of two seconds."""
    columns = np.array(sorted(notes)).reshape(-1, 4).T
    lines = np.linspace(0.0, (bars - 1) * BAR_S, bars)
    return MusicForm(*columns, bar_lines_s=lines, duration_s=bars * BAR_S, **fields)


def _run(start_s: float, end_s: float, step_s: float, pitch: float, velocity: float) -> list[Any]:
    return [
        (float(t), float(t) + 0.9 * step_s, pitch, velocity) for t in np.arange(start_s, end_s - 1e-9, step_s)
    ]


def _march() -> MusicForm:
    """Eight bars plain, eight fast, eight soft, eight loud; each a phrase."""
    notes = (
        _run(0, 16, 0.5, 67, 0.7)
        + _run(16, 32, 0.15, 67, 0.7)
        + _run(32, 48, 0.5, 65, 0.5)
        + _run(48, 64, 0.5, 67, 0.9)
    )
    return _form(notes, 32, phrases_s=np.array([[0.0, 16.0], [16.0, 32.0], [32.0, 48.0], [48.0, 64.0]]))


def _shots(show: Show) -> list[tuple[float, str]]:
    """When which shot begins."""
    starts = {shot.start.position: name for name, shot in SHOTS.items()}
    keyframes = show.track("camera/position").keyframes
    return [(key.time, starts[key.value]) for key in keyframes if key.value in starts]


def test_a_show_is_written_the_same_each_time_and_is_a_document() -> None:
    show = write_default_show(_march(), title="March")
    assert show == write_default_show(_march(), title="March")
    assert Show.from_document(show.to_document(), REGISTRY) == show
    assert show.title == "March"


def test_it_looks_where_the_music_is() -> None:
    shots = dict(_shots(write_default_show(_march())))
    assert shots[0.0] == "room"
    assert shots[8.0] == "valves"
    assert shots[16.0] == "profile"
    assert shots[24.0] == "low"


def test_fast_music_is_cut_faster_and_never_hastily() -> None:
    slow = _form(_run(0, 64, 1.0, 67, 0.7), 32, phrases_s=np.array([[0.0, 64.0]]))
    fast = _form(_run(0, 64, 0.15, 67, 0.7), 32, phrases_s=np.array([[0.0, 64.0]]))
    assert len(passages(fast)) >= 2 * len(passages(slow))
    lengths_s = np.diff([time * BAR_S for time, _ in _shots(write_default_show(fast))])
    assert lengths_s.min() >= SHORTEST_S
    assert lengths_s.mean() <= 5.0


def test_it_has_variety() -> None:
    """Of three shots in a row no two are the same, but for the room, and most kinds are seen."""
    random = np.random.default_rng(5)
    notes = [
        note
        for phrase in range(12)
        for note in _run(8 * phrase, 8 * phrase + 7, 0.4, 60 + 12 * random.random(), random.uniform(0.4, 1))
    ]
    phrases = np.array([[8.0 * phrase, 8.0 * phrase + 7.0] for phrase in range(12)])
    shots = [name for _, name in _shots(write_default_show(_form(notes, 48, phrases_s=phrases)))]
    assert shots[0] == shots[-1] == "room"
    assert len(set(shots)) >= 6
    assert all(before != after for before, after in pairwise(shots))


def test_light_and_colour_go_by_phrase() -> None:
    show = write_default_show(_march())
    sun = {key.time: key.value for key in show.track("lights/key/intensity").keyframes}
    assert sun[24.0] > sun[0.0] > sun[16.0]
    plan = show.plan(REGISTRY, TimeMap.steady(120.0))
    values, _ = plan.evaluate(np.array([4.0, 20.0, 36.0, 52.0]))
    for path in ("blocks/color", "lights/back_wash/color", "lights/rim/color"):
        offset = REGISTRY.layout()[path][0]
        colors = values[:, offset : offset + 3]
        assert all(np.abs(a - b).max() > 0.02 for a, b in pairwise(colors)), path


def test_markers_say_why() -> None:
    names = {marker.time: marker.name for marker in write_default_show(_march()).markers}
    assert names[0.0] == "Beginning"
    assert names[8.0] == "Fast"
    assert names[16.0] == "Soft"
    assert names[24.0] == "Loud"


def test_a_long_rest_is_seen_from_afar() -> None:
    notes = _run(0, 16, 0.5, 67, 0.7) + _run(32, 48, 0.5, 67, 0.7)
    show = write_default_show(_form(notes, 24, phrases_s=np.array([[0.0, 16.0], [32.0, 48.0]])))
    resting = [name for time, name in _shots(show) if 8.0 <= time < 16.0]
    assert "room" in resting


@st.composite
def forms(draw: st.DrawFn) -> MusicForm:
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    bars = draw(st.integers(1, 60))
    count = draw(st.integers(0, 80))
    onset = np.sort(random.uniform(0.0, bars * BAR_S, count))
    starts = np.sort(random.uniform(0.0, bars * BAR_S, draw(st.integers(0, 8))))
    return MusicForm(
        onset_s=onset,
        end_s=onset + random.uniform(0.05, 1.0, count),
        pitch=random.integers(54, 84, count).astype(np.float64),
        velocity=random.uniform(0.0, 1.0, count),
        bar_lines_s=np.linspace(0.0, (bars - 1) * BAR_S, bars),
        duration_s=bars * BAR_S,
        phrases_s=np.stack([starts, starts + 1.0], axis=1),
    )


@given(forms())
def test_passages_cover_the_piece_and_are_neither_short_nor_long(form: MusicForm) -> None:
    found = passages(form)
    assert found[0].start_bar == 0
    assert found[-1].end_bar == form.bar_lines_s.size
    assert all(before.end_bar == after.start_bar for before, after in pairwise(found))
    lengths = [(passage.end_bar - passage.start_bar) * BAR_S for passage in found]
    assert max(lengths) <= LONGEST_S + BAR_S
    assert min(lengths) >= min(SHORTEST_S, form.duration_s)
    assert all(0.0 <= passage.sounding <= 1.0 for passage in found)


@given(forms())
def test_any_form_makes_a_show_that_cuts_on_bars_and_keeps_the_fingers_in_the_picture(
    form: MusicForm,
) -> None:
    show = write_default_show(form)
    assert Show.from_document(show.to_document(), REGISTRY) == show
    shots = [name for _, name in _shots(show)]
    assert all(before != after for before, after in pairwise(shots))
    times = np.arange(0.0, form.duration_s, 0.25)
    values, cuts = show.plan(REGISTRY, TimeMap.steady(120.0), fps=4.0).evaluate(times)
    assert np.all(times[cuts] % BAR_S == 0.0)
    assert cuts.sum() == len(shots) - 1
    assert furthest_out(values, VALVES, REGISTRY).max() < 0.85


def test_a_piece_is_compared_with_its_own_means() -> None:
    piece = Piece.of(passages(_march()))
    assert piece.loudness == pytest.approx((0.7 + 0.7 + 0.5 + 0.9) / 4, abs=0.02)


def test_forms_that_make_no_sense_are_refused() -> None:
    with pytest.raises(ValueError, match="one length"):
        MusicForm(np.zeros(2), np.zeros(2), np.zeros(2), np.zeros(1), bar_lines_s=np.zeros(1), duration_s=1.0)
    with pytest.raises(ValueError, match="increase"):
        MusicForm(*np.zeros((4, 0)), bar_lines_s=np.array([1.0, 0.0]), duration_s=1.0)


def test_a_piece_without_bar_lines_or_notes_still_has_a_show() -> None:
    form = MusicForm(*np.zeros((4, 0)), bar_lines_s=np.zeros(0), duration_s=0.0)
    show = write_default_show(form)
    values, _ = show.plan(REGISTRY).evaluate(np.zeros(1))
    assert furthest_out(values, VALVES, REGISTRY).max() < 0.85
