"""The root of Reina's one error tree.

A message says what was wrong, where, and what would be right, to the person who sent the input.
"""


class ReinaError(Exception):
    """Anything that Reina refuses to do, with the reason in the sender's own terms."""


class InputError(ReinaError):
    """Input that cannot be used.

    Attributes:
        detail: What was wrong and what would be right, one sentence or two.
        location: The place in the input (``"track 2, byte 118"``, ``"tracks/3/keyframes/0/value"``), or None.
    """

    def __init__(self, detail: str, *, location: str | None = None) -> None:
        super().__init__(detail if location is None else f"{location}: {detail}")
        self.detail = detail
        self.location = location
