"""The root of Reina's one error tree.

A message says what was wrong, where, and what would be right, to the person who sent the input.
"""


class ReinaError(Exception):
    """Anything that Reina refuses to do, with the reason in the sender's own terms."""


class InputError(ReinaError):
    """Input that cannot be used.

    Attributes:
        detail: What was wrong and what would be right, one sentence or two.
        where: The place in the input (``"track 2, byte 118"``, ``"tracks/3/keyframes/0/value"``), or None.
    """

    def __init__(self, detail: str, *, where: str | None = None) -> None:
        super().__init__(detail if where is None else f"{where}: {detail}")
        self.detail = detail
        self.where = where
