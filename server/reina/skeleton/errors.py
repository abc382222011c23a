"""What can be wrong with a skeleton, a rig or a clip."""

from __future__ import annotations

from reina.errors import InputError


class RigError(InputError):
    """A rig or a hold that cannot be used; ``where`` is the path in its document, ``joints/12/rotation``."""


class PoseError(InputError):
    """A motion file that has no person's pose at a time; ``where`` names the joint or the time."""


class BvhError(InputError):
    """A BVH file that cannot be read; ``where`` names the line."""
