"""A hit on a drum kit, as far as paper needs to know of it."""

from typing import Protocol


class Struck(Protocol):
    """One hit."""

    @property
    def onset_s(self) -> float:
        """When, seconds."""
        ...

    @property
    def onset_beats(self) -> float:
        """When, quarter notes."""
        ...

    @property
    def piece(self) -> str:
        """What is struck: ``snare``, ``kick``, ``hi_hat``."""
        ...

    @property
    def zone(self) -> str:
        """Where on it: ``centre``, ``rim``, ``bow``, ``bell``, ``edge``."""
        ...

    @property
    def limb(self) -> str:
        """With what: ``right_hand``, ``left_hand``, ``right_foot``, ``left_foot``."""
        ...

    @property
    def technique(self) -> str | None:
        """How, where it is no plain stroke: ``ghost``, ``flam_grace``, ``open``."""
        ...
