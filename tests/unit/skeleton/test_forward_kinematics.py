import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from reina.skeleton import RigError, Skeleton, forward_kinematics


def random_skeleton(seed: int, joints: int = 20) -> Skeleton:
    rng = np.random.default_rng(seed)
    parents = np.array([-1, *(int(rng.integers(0, i)) for i in range(1, joints))], dtype=np.intp)
    return Skeleton(
        tuple(f"joint{i}" for i in range(joints)),
        parents,
        rng.normal(scale=0.2, size=(joints, 3)),
        Rotation.random(joints, random_state=seed).as_quat(),
    )


def test_agrees_with_matrices_multiplied_joint_by_joint() -> None:
    skeleton = random_skeleton(1)
    rotations = Rotation.random(60 * 20, random_state=2).as_quat().reshape(60, 20, 4)
    roots = np.random.default_rng(3).normal(size=(60, 3))
    positions, world = forward_kinematics(skeleton, rotations, roots)
    for frame in (0, 17, 59):
        matrices: list[np.ndarray] = []
        for joint, parent in enumerate(skeleton.parents):
            link = np.eye(4)
            link[:3, 3] = roots[frame] if joint == 0 else skeleton.rest_translations[joint]
            turn = np.eye(4)
            turn[:3, :3] = Rotation.from_quat(rotations[frame, joint]).as_matrix()
            above: np.ndarray = np.eye(4) if joint == 0 else matrices[int(parent)]
            matrices.append(above @ link @ turn)
        np.testing.assert_allclose(positions[frame], [m[:3, 3] for m in matrices], atol=1e-12)
        found = Rotation.from_quat(world[frame]).as_matrix()
        np.testing.assert_allclose(found, [m[:3, :3] for m in matrices], atol=1e-12)


def test_a_block_gives_what_its_frames_give_one_by_one() -> None:
    skeleton = random_skeleton(4)
    rotations = Rotation.random(5 * 20, random_state=5).as_quat().reshape(5, 20, 4)
    positions, _ = forward_kinematics(skeleton, rotations)
    for frame in range(5):
        alone, _ = forward_kinematics(skeleton, rotations[frame])
        np.testing.assert_allclose(positions[frame], alone, atol=1e-14)
    np.testing.assert_array_equal(positions[:, 0], np.broadcast_to(skeleton.rest_translations[0], (5, 3)))


def test_wrong_shapes_are_named() -> None:
    with pytest.raises(ValueError, match=r"20 joints.*\(3, 4\)"):
        forward_kinematics(random_skeleton(6), np.zeros((3, 4)))


def test_levels_hold_every_joint_once_after_its_parent() -> None:
    skeleton = random_skeleton(7)
    seen: set[int] = {-1}
    for level in skeleton.levels:
        assert all(int(skeleton.parents[joint]) in seen for joint in level)
        seen |= set(level.tolist())
    assert len(seen) == len(skeleton) + 1


def test_ancestors_lead_down_from_the_root() -> None:
    skeleton = random_skeleton(8)
    for joint in range(1, len(skeleton)):
        path = skeleton.ancestors(joint)
        assert path[0] == 0
        assert path[-1] == skeleton.parents[joint]
    assert skeleton.ancestors(0) == []


@pytest.mark.parametrize(
    ("names", "parents", "w", "message"),
    [
        (("a", "a"), [-1, 0], 1.0, "two joints are called 'a'"),
        (("a", "b"), [-1, 1], 1.0, "joints/1/parent: joint 'b' must have a parent that stands before it"),
        (("a", "b"), [0, 0], 1.0, "joints/0/parent"),
        (("a", "b"), [-1, -1], 1.0, "joints/1/parent"),
        (("a", "b"), [-1, 0], 2.0, "joints/0/rotation.*length 2"),
        (("a",), [-1, 0], 1.0, r"parents of 1 joints have shape \(1,\), not \(2,\)"),
        ((), [], 1.0, "at least one joint"),
    ],
)
def test_broken_trees_are_refused(names: tuple[str, ...], parents: list[int], w: float, message: str) -> None:
    rotations = np.tile([0.0, 0.0, 0.0, w], (len(names), 1))
    with pytest.raises(RigError, match=message):
        Skeleton(names, np.array(parents, dtype=np.intp), np.zeros((len(names), 3)), rotations)


def test_an_unknown_joint_lists_the_known() -> None:
    with pytest.raises(RigError, match="no joint 'tail'; the joints are joint0"):
        random_skeleton(9).index("tail")
