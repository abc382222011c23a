"""What was repaired or left out in a motion file, told to the person who sent it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class ClipWarning:
    """One thing that is not as the file says.

    Attributes:
        kind: A stable name for programs, such as ``frame_count`` (docs/lab.md lists them).
        place: The line, ``"line 19"``.
        message: What was found and what was made of it.
    """

    kind: str
    place: str
    message: str
