"""Each amount at 0 stills its own gesture and no other, read off the frames."""

from collections.abc import Callable

import numpy as np
import pytest

from reina import rotations as r
from reina.instruments.player.amounts import PLAYER_PARAMETERS
from reina.performance import Performance
from reina.skeleton import Rig

NoteBeats = tuple[float, float, int]
Perform = Callable[..., Performance]

BLOCKS = 22
AMOUNTS = tuple(parameter.path for parameter in PLAYER_PARAMETERS if parameter.type == "number")

SEEN_IN: dict[str, set[str]] = {
    "player/breath": {"chest", "leftShoulder", "face/jaw_open", "face/smile"},
    "player/sway": {"hips", "spine", "head", "root"},
    "player/lean": {"hips", "spine", "head", "root"},
    "player/turn": {"hips", "spine", "upperChest", "root"},
    "player/lift": {"upperChest", "neck", "leftShoulder"},
    "player/vibrato": {"rightHand"},
    "player/finger_lift": {"rightIndexProximal", "rightMiddleProximal", "rightRingProximal"},
    "player/face": {"face/mouth_pucker", "face/mouth_press", "face/brow_up"},
    "player/cheeks": {"face/cheek_puff"},
    "player/tongue": {"face/mouth_press"},
    "player/blink": {"face/blink_left", "face/blink_right"},
    "player/gaze": {"leftEye", "rightEye"},
    "player/lower": {"leftUpperArm", "rightUpperArm", "instrument"},
    "player/stance/amount": {"hips", "spine", "root"},
}
"""Where each gesture is seen: some of the joints, morphs and places that it moves."""

TOGETHER: dict[str, set[str]] = {
    "player/breath": {"face/jaw_open", "face/smile", "face/mouth_press", "face/mouth_pucker", "face/brow_up"},
    "player/face": {"face/smile", "face/mouth_press", "face/mouth_pucker", "face/brow_up"},
    "player/lower": {"face/smile"},
}
"""Weights that several gestures share and that are kept within 0 and 1, so that they do not add up."""

TRUNK = ("hips", "spine", "chest", "upperChest", "neck", "head", "leftShoulder", "rightShoulder")


class Seen:
    """What frames show: turns of joints from the first frame of the bare hold, morphs, the root's place."""

    def __init__(self, performance: Performance, rig: Rig) -> None:
        blocks = [performance.evaluate(block) for block in range(BLOCKS)]
        rotations = np.concatenate([block.rotations for block in blocks]).astype(np.float64)
        parameters = np.concatenate([block.parameters for block in blocks]).astype(np.float64)
        self.tracks: dict[str, np.ndarray] = {
            name: rotations[:, joint] for joint, name in enumerate(rig.skeleton.names)
        }
        self.tracks["instrument"] = rotations[:, -1]
        self.tracks["root"] = np.concatenate([block.root_positions[:, 0] for block in blocks]).astype(
            np.float64
        )
        offset = 0
        for parameter in performance.layout.parameters:
            if parameter.path.startswith(("face/", "trumpet/")):
                self.tracks[parameter.path] = parameters[:, offset : offset + 1]
            offset += parameter.length

    def moved(self, other: "Seen") -> set[str]:
        """What differs from other frames, by more than rounding."""
        return {
            name for name, track in self.tracks.items() if np.abs(track - other.tracks[name]).max() > 2e-6
        }


@pytest.fixture(scope="module")
def seen(perform: Perform, tune: list[NoteBeats], player_rig: Rig) -> Callable[..., Seen]:
    known: dict[tuple[tuple[str, float], ...], Seen] = {}

    def see(**values: float) -> Seen:
        key = tuple(sorted(values.items()))
        if key not in known:
            known[key] = Seen(perform(tune, values=values), player_rig)
        return known[key]

    return see


def nothing() -> dict[str, float]:
    return dict.fromkeys(AMOUNTS, 0.0)


def test_every_amount_has_a_row_here() -> None:
    assert set(SEEN_IN) == set(AMOUNTS)
    for parameter in PLAYER_PARAMETERS:
        assert parameter.documentation.endswith(".")
        assert parameter.type == "choice" or (parameter.minimum == 0.0 and parameter.default == 1.0)


def test_with_all_amounts_at_0_valves_alone_move(seen: Callable[..., Seen], player_rig: Rig) -> None:
    bare = seen(**nothing())
    moving = {name for name, track in bare.tracks.items() if np.ptp(track, axis=0).max() > 0.0}
    valves = {f"trumpet/valve/{valve}" for valve in (1, 2, 3)}
    fingers = {
        f"right{finger}{bone}"
        for finger in ("Index", "Middle", "Ring")
        for bone in ("Proximal", "Intermediate", "Distal")
    }
    slide = {"trumpet/slide/3", *(f"leftRing{bone}" for bone in ("Proximal", "Intermediate", "Distal"))}
    assert valves < moving
    assert moving <= valves | fingers | slide


@pytest.mark.parametrize("path", AMOUNTS)
def test_an_amount_of_0_stills_its_gesture_alone(seen: Callable[..., Seen], path: str) -> None:
    bare, only = seen(**nothing()), seen(**(nothing() | {path: 1.0}))
    # The stance turns joints before the gestures do, so turns add up exactly only without it.
    others = {} if path == "player/stance/amount" else {"player/stance/amount": 0.0}
    whole, without = seen(**others), seen(**(others | {path: 0.0}))
    # By itself the gesture is seen where it belongs, and it is gone from there at 0.
    assert only.moved(bare) >= SEEN_IN[path]
    assert whole.moved(without) >= SEEN_IN[path]
    # What 0 takes away from the whole is what the gesture is by itself: no other gesture is touched by it.
    for name in whole.tracks:
        if name.startswith("face/") and name not in TOGETHER.get(path, ()):
            taken = whole.tracks[name] - without.tracks[name]
            added = only.tracks[name] - bare.tracks[name]
            inside = (without.tracks[name] > 0.0) | (added > 0.0)  # weights are kept within 0 and 1
            np.testing.assert_allclose(taken[inside], added[inside], atol=1e-6, err_msg=name)
        elif name.startswith("trumpet/"):
            np.testing.assert_array_equal(whole.tracks[name], without.tracks[name])
    if path not in ("player/lower", "player/stance/amount"):
        for name in TRUNK:
            held = bare.tracks[name][0]
            turns = [r.log(r.multiply(r.conjugate(held), one.tracks[name])) for one in (whole, without, only)]
            np.testing.assert_allclose(turns[0] - turns[1], turns[2], atol=2e-6, err_msg=name)
    elif path == "player/lower":
        for name in (*TRUNK, "root"):
            np.testing.assert_array_equal(whole.tracks[name], without.tracks[name])
