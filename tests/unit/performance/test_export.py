from collections.abc import Callable

import numpy as np
import pytest

from reina import rotations as r
from reina.performance import Performance, performance_clip
from reina.skeleton import Rig, forward_kinematics, read_bvh, write_bvh


def test_an_exported_performance_stands_where_its_frames_stand(
    perform: Callable[..., Performance], tune: list[tuple[float, float, int]], player_rig: Rig
) -> None:
    performance = perform(tune)
    clip = read_bvh(write_bvh(performance_clip(performance, player_rig, 90, 100)))
    assert len(clip) == 100
    assert clip.frame_time_s == pytest.approx(1 / 60, abs=1e-8)
    local, translations = clip.motion()
    world, places = np.empty(local.shape), np.empty(translations.shape)
    for joint, parent in enumerate(clip.parents.tolist()):
        if joint == 0:
            world[:, 0], places[:, 0] = local[:, 0], translations[:, 0]
        else:
            world[:, joint] = r.multiply(world[:, parent], local[:, joint])
            places[:, joint] = places[:, parent] + r.rotate(world[:, parent], translations[:, joint])
    block = performance.evaluate(2)  # frames 120 to 179 are the clip's 30 to 89
    wanted, _ = forward_kinematics(player_rig.skeleton, block.rotations[:, :58], block.root_positions[:, 0])
    for joint, name in enumerate(player_rig.skeleton.names):
        np.testing.assert_allclose(places[30:90, clip.names.index(name)], wanted[:, joint], atol=1e-5)


def test_an_empty_span_is_refused(
    perform: Callable[..., Performance], tune: list[tuple[float, float, int]], player_rig: Rig
) -> None:
    with pytest.raises(ValueError, match="not 0 from 5"):
        performance_clip(perform(tune), player_rig, 5, 0)
