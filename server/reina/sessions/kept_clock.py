"""A music clock as it is kept: what it said at one time, from which all later times follow."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from reina.music import ClockState

Finite = Annotated[float, Field(allow_inf_nan=False)]


class KeptClock(BaseModel):
    """A clock's state at one time; song time is arithmetic from there on."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    at_s: Finite = 0.0
    """When it was so: seconds since 1970."""
    playing: bool = False
    song_time_s: Finite = 0.0
    rate: Finite = 1.0
    loop: tuple[Finite, Finite] | None = None
    count_in_s: Finite = 0.0
    """Song seconds that were still counted in."""
    loop_count_in_s: Finite = 0.0
    epoch: int = 0

    @classmethod
    def of(cls, state: ClockState, wall_s: float) -> KeptClock:
        """What is to be kept of a state that holds at present.

        Args:
            state: The clock at present.
            wall_s: The present, seconds since 1970.
        """
        return cls(
            at_s=wall_s,
            playing=state.playing,
            song_time_s=state.song_time_s,
            rate=state.rate,
            loop=state.loop,
            count_in_s=state.count_in_s,
            loop_count_in_s=state.loop_count_in_s,
            epoch=state.epoch,
        )

    def state(self, now_s: float, wall_s: float, *, ahead_s: float = 0.0) -> ClockState:
        """The state, put at the server time at which it was so.

        A calendar that was set back since gives no time before it: song time stands still for once.

        Args:
            now_s: The present as server time.
            wall_s: The present, seconds since 1970.
            ahead_s: By how much the calendar of who kept it may be ahead of this one: so far in the future
                it may have been so.
        """
        return ClockState(
            playing=self.playing,
            song_time_s=self.song_time_s,
            server_time_s=now_s - max(wall_s - self.at_s, -ahead_s),
            rate=self.rate,
            loop=self.loop,
            epoch=self.epoch,
            duration_s=self.song_time_s,
            count_in_s=self.count_in_s,
            loop_count_in_s=self.loop_count_in_s,
        )
