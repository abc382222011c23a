"""What can be wrong with a question to the laboratory."""

from __future__ import annotations

from reina.errors import InputError


class LabError(InputError):
    """A question that has no answer; ``where`` is the field, ``angles_rad/2``."""
