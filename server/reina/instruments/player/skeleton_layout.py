"""A skeleton's place in the frame."""

from dataclasses import dataclass


@dataclass(frozen=True)
class SkeletonLayout:
    """A skeleton in the frame.

    Attributes:
        name: Its name there.
        rig: Its rig.
        joints: Its joints' names, parents first.
        player: Whose it is: a place in the cast, the first being 0.
        reaches: How far what each joint turns is from it at most, metres.
    """

    name: str
    rig: str
    joints: tuple[str, ...]
    player: int
    reaches: tuple[float, ...]
