"""A show with its past and what was taken back."""

from dataclasses import dataclass

from reina.show.show import Show


@dataclass(frozen=True)
class ShowHistory:
    """A show with what it was before and what was taken back. Never changed; each step gives a new history.

    Shows share the tracks that did not change, and tracks the keyframes, so that a step costs little more
    than what it touched.

    Attributes:
        show: As it is.
        past: What it was, the latest last.
        future: What was taken back, the next to be done again last.
        longest: How many steps are kept.
    """

    show: Show
    past: tuple[Show, ...] = ()
    future: tuple[Show, ...] = ()
    longest: int = 200

    def then(self, show: Show) -> "ShowHistory":
        """The history after an edit; what was taken back is forgotten."""
        if show == self.show:
            return self
        return ShowHistory(show, (*self.past, self.show)[-self.longest :], (), self.longest)

    def undone(self) -> "ShowHistory":
        """One step back, or the same where there is none."""
        if not self.past:
            return self
        return ShowHistory(self.past[-1], self.past[:-1], (*self.future, self.show), self.longest)

    def redone(self) -> "ShowHistory":
        """One step forward again, or the same where nothing was taken back."""
        if not self.future:
            return self
        return ShowHistory(self.future[-1], (*self.past, self.show), self.future[:-1], self.longest)
