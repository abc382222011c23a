"""The golden edits: what the server makes of edits and of the music's time, which the page works out too.

`python -m tests.contract.golden_edits` writes tests/golden/show_edits.json anew; the page's tests read the
same file, so that until the server has answered the page shows what the server will say.
"""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import mido
import numpy as np

from reina.music import Score, read_score
from reina.sessions.music_arrays import bar_lines_beats, time_map
from reina.show import Show, with_edits
from reina.stage import stage_registry

FILE = Path(__file__).parents[1] / "golden" / "show_edits.json"
TICKS = 480
LIGHT, FOV, POSITION, COLOR = "lights/key/intensity", "camera/fov", "camera/position", "blocks/color"
REGISTRY = stage_registry()
METRES = ((0, 4, 4), (8, 3, 4), (14, 6, 8))
"""Beat, numerator and denominator."""
TEMPI = ((0, 120.0), (6, 96.0), (8, 60.0), (14, 90.0), (15.5, 150.0))
"""Beat and quarter notes a minute: changes on a bar line and within a bar."""
END_BEATS = 20

SHOW: dict[str, Any] = {
    "version": 1,
    "title": "Evening",
    "time": "beats",
    "markers": [{"time": 4, "name": "Theme"}],
    "tracks": [
        {
            "parameter": LIGHT,
            "keyframes": [
                {"key": "k1", "time": 0, "value": 1, "interpolation": "linear", "out_tangent": 0.5},
                {
                    "key": "k2",
                    "time": 7,
                    "value": 2,
                    "interpolation": "cubic_spline",
                    "in_tangent": 0.25,
                    "out_tangent": -0.5,
                },
                {"key": "k3", "time": 10, "value": 3, "interpolation": "linear"},
                {"key": "k4", "time": 17, "value": 1, "interpolation": "back_in", "overshoot": 2},
            ],
        },
        {
            "parameter": POSITION,
            "time": "bars",
            "after": "loop",
            "keyframes": [
                {"key": "a", "time": 0.5, "value": [0, 1, 2], "interpolation": "linear"},
                {
                    "key": "b",
                    "time": 2.25,
                    "value": [1, 1, 2],
                    "interpolation": "cubic_spline",
                    "in_tangent": [1, 0, -0.5],
                },
            ],
        },
        {
            "parameter": FOV,
            "time": "seconds",
            "muted": True,
            "events": {"on": "bars", "attack": 0.25, "decay": 1, "amount": 0.1, "blend": "add"},
            "keyframes": [{"key": "k1", "time": 1.5, "value": 0.5, "interpolation": "linear"}],
        },
        {"parameter": "no/such", "keyframes": [{"time": 0, "value": 1}]},
    ],
}

BENT = {
    "key": "k2",
    "time": 9,
    "value": 4,
    "interpolation": "cubic_bezier",
    "handles": [0.4, 0.0, 0.2, 1.0],
}


def _add(parameter: str, keyframe: dict[str, Any]) -> dict[str, Any]:
    return {"edit": "add_keyframe", "parameter": parameter, "keyframe": keyframe}


def _change(parameter: str, key: str, **changes: Any) -> dict[str, Any]:
    return {"edit": "change_keyframe", "parameter": parameter, "key": key, "changes": changes}


def _remove(parameter: str, key: str) -> dict[str, Any]:
    return {"edit": "remove_keyframe", "parameter": parameter, "key": key}


def _move(keyframes: dict[str, list[str]], by: float, about: float = 0, factor: float = 1) -> dict[str, Any]:
    stretch = {"about": about, "factor": factor}
    return {"edit": "move_keyframes", "keyframes": keyframes, "time": "beats", "by": by, "stretch": stretch}


def _change_track(parameter: str, **changes: Any) -> dict[str, Any]:
    return {"edit": "change_track", "parameter": parameter, "changes": changes}


EDITS: dict[str, list[dict[str, Any]]] = {
    "a keyframe is added between others": [
        _add(LIGHT, {"key": "new", "time": 3.5, "value": 2, "interpolation": "sine_in"})
    ],
    "a first keyframe makes a track": [
        _add("stage/exposure", {"key": "k1", "time": 2, "value": 2, "interpolation": "linear"})
    ],
    "a keyframe is changed and moved past another": [_change(LIGHT, "k1", time=8, value=0.5)],
    "two keyframes change places": [_change(LIGHT, "k1", time=7), _change(LIGHT, "k2", time=0)],
    "another interpolation drops the options": [_change(LIGHT, "k4", interpolation="quad_out")],
    "null takes options and slopes back": [
        _change(LIGHT, "k4", overshoot=None),
        _change(LIGHT, "k2", in_tangent=None),
    ],
    "a keyframe is removed": [_remove(LIGHT, "k3")],
    "a track goes with its last keyframe": [_remove(POSITION, "a"), _remove(POSITION, "b")],
    "a track that answers events stays without keyframes": [_remove(FOV, "k1")],
    "keyframes of all units move over changes of tempo": [
        _move({LIGHT: ["k2", "k3"], POSITION: ["b"], FOV: ["k1"]}, 2.5)
    ],
    "what stands in the way makes room": [_move({LIGHT: ["k1"]}, 7)],
    "keyframes are stretched and their slopes become flatter": [
        _move({LIGHT: ["k1", "k2", "k3"], POSITION: ["a", "b"]}, 0.5, about=6, factor=1.5)
    ],
    "a track is put": [
        {
            "edit": "put_track",
            "track": {
                "parameter": LIGHT,
                "time": "seconds",
                "keyframes": [{**BENT, "key": "k1", "time": 1.5}, BENT],
            },
        }
    ],
    "a new track is put and edited": [
        {
            "edit": "put_track",
            "track": {
                "parameter": COLOR,
                "keyframes": [{"key": "k1", "time": 0, "value": "#112233", "interpolation": "linear"}],
            },
        },
        _add(COLOR, {"key": "k2", "time": 4, "value": [0.1, 0.2, 0.3], "interpolation": "linear"}),
    ],
    "a track is changed beside its keyframes": [_change_track(LIGHT, after="ping_pong", solo=True)],
    "null takes fields of a track back": [
        _change_track(POSITION, after=None),
        _change_track(FOV, muted=None),
    ],
    "a track counts in seconds": [_change_track(LIGHT, time="seconds")],
    "a track counts in bars": [_change_track(LIGHT, time="bars")],
    "a track counts in the show's unit": [_change_track(POSITION, time=None)],
    "an answer to events counts anew with its track": [_change_track(FOV, time="bars")],
    "an answer to events comes and goes": [
        _change_track(LIGHT, events={"on": "notes", "hold": 0.5, "cycle": [1, 2]}),
        _change_track(FOV, events=None),
    ],
    "tracks are removed": [
        {"edit": "remove_track", "parameter": POSITION},
        {"edit": "remove_track", "parameter": "no/such"},
    ],
    "the show's words and markers": [
        {
            "edit": "change_show",
            "changes": {"title": "Dusk", "markers": [{"time": 2, "name": "A"}, {"time": 9, "name": "B"}]},
        }
    ],
    "null takes words and markers back": [
        {"edit": "change_show", "changes": {"title": None, "markers": None}}
    ],
}
"""Edits that the page sends, by what they show."""


def score() -> Score:
    """A score with changes of tempo and metre."""
    midi = mido.MidiFile(ticks_per_beat=TICKS)
    track = mido.MidiTrack()
    midi.tracks.append(track)
    events: list[tuple[float, mido.MetaMessage | mido.Message]] = [
        *((b, mido.MetaMessage("time_signature", numerator=n, denominator=d)) for b, n, d in METRES),
        *((beat, mido.MetaMessage("set_tempo", tempo=mido.bpm2tempo(bpm))) for beat, bpm in TEMPI),
        (0, mido.Message("note_on", note=60, velocity=90)),
        (END_BEATS, mido.Message("note_off", note=60)),
    ]
    tick = 0
    for beat, message in sorted(events, key=lambda event: event[0]):
        message.time = round(beat * TICKS) - tick
        tick += message.time
        track.append(message)
    file = io.BytesIO()
    midi.save(file=file)
    return read_score(file.getvalue())


def golden() -> dict[str, Any]:
    """The whole file: the score as the page is told of it, places in all three units, and edits."""
    piece = score()
    times = time_map(piece)
    seconds = np.concatenate([np.arange(0, 61) * 0.25, times.to_seconds(bar_lines_beats(piece), "beats")])
    seconds = np.unique(np.round(seconds, 9)).astype(np.float64)
    before = Show.from_document(SHOW, REGISTRY)
    tempo_map = piece.tempo_map
    return {
        "score": {
            "tempi": [
                {"onset_beats": tempo.onset_beats, "onset_s": tempo.onset_s, "bpm": tempo.beats_per_minute}
                for tempo in tempo_map.tempos
            ],
            "bar_lines_s": tempo_map.seconds(bar_lines_beats(piece)).tolist(),
        },
        "places": [
            {"seconds": at_s, "beats": beats, "bars": bars}
            for at_s, beats, bars in zip(
                seconds.tolist(),
                times.from_seconds(seconds, "beats").tolist(),
                times.from_seconds(seconds, "bars").tolist(),
                strict=True,
            )
        ],
        "show": before.to_document(),
        "cases": [
            {
                "name": name,
                "edits": edits,
                "edited": with_edits(before, edits, REGISTRY, times).to_document(),
            }
            for name, edits in EDITS.items()
        ],
    }


if __name__ == "__main__":
    FILE.write_text(json.dumps(golden(), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
