"""The music clock: which song time is heard at which server time."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from reina.errors import InputError
from reina.music.arrays import FloatArray, IntArray

SLOWEST_RATE = 0.1
FASTEST_RATE = 4.0
SHORTEST_LOOP_S = 0.1
LONGEST_COUNT_IN_S = 120.0
"""Song seconds: two long bars of a slow movement are far less."""


class ClockError(InputError):
    """A transport action that cannot be done."""


@dataclass(frozen=True)
class Span:
    """Song time that runs on without a jump.

    Attributes:
        server_time_s: Server time at which it begins.
        start_s: Song time at which it begins.
        end_s: Song time up to which it runs, not included unless it is the song's end.
        ends_song: Whether it runs to the song's end.
    """

    server_time_s: float
    start_s: float
    end_s: float
    ends_song: bool = False


@dataclass(frozen=True)
class ClockState:
    """What the clock says at one server time; it holds until the clock is changed, which raises the epoch.

    Attributes:
        playing: Whether song time runs.
        song_time_s: Song time heard at `server_time_s`.
        server_time_s: The server time that is spoken of.
        rate: Song seconds a server second.
        loop: Start and end of the loop in song time, or None.
        epoch: Counts the changes.
        duration_s: Where the song ends.
        count_in_s: Song seconds that are still counted in: so long song time stands before it runs. They pass
            at the rate, so that a bar counted in lasts as long as the bar that follows.
        loop_count_in_s: Song seconds that are counted in before each further round of the loop.
    """

    playing: bool
    song_time_s: float
    server_time_s: float
    rate: float
    loop: tuple[float, float] | None
    epoch: int
    duration_s: float
    count_in_s: float = 0.0
    loop_count_in_s: float = 0.0

    @property
    def _looping(self) -> tuple[float, float] | None:
        """The loop, if playing on from here comes to its end."""
        return self.loop if self.loop is not None and self.song_time_s < self.loop[1] else None

    @property
    def _begin(self) -> float:
        """Where song time would stand if what is counted in were song before it."""
        return self.song_time_s - self.count_in_s

    def song_times_at(self, server_times_s: ArrayLike) -> FloatArray:
        """Return the song times heard at server times, of the same shape; before this state, its own."""
        at = np.asarray(server_times_s, dtype=np.float64)
        if not self.playing:
            return np.full(at.shape, self.song_time_s)
        run = self._begin + np.maximum(at - self.server_time_s, 0.0) * self.rate
        counted = np.maximum(run, self.song_time_s)
        loop = self._looping
        if loop is not None:
            start, end = loop
            round_s = self.loop_count_in_s + end - start
            within = np.mod(run - end, round_s) - self.loop_count_in_s
            return np.where(run < end, counted, start + np.maximum(within, 0.0))
        return np.minimum(counted, self.duration_s)

    def _count_in_at(self, server_time_s: float) -> float:
        """Song seconds that are still counted in at a server time."""
        if not self.playing:
            return 0.0
        run = self._begin + max(server_time_s - self.server_time_s, 0.0) * self.rate
        loop = self._looping
        if loop is not None and run >= loop[1]:
            round_s = self.loop_count_in_s + loop[1] - loop[0]
            return max(self.loop_count_in_s - math.fmod(run - loop[1], round_s), 0.0)
        return max(self.song_time_s - run, 0.0)

    def at(self, server_time_s: float) -> "ClockState":
        """Return the state at a later server time; at the song's end it is paused.

        Before this state, as where another server's calendar is ahead, it is this one.
        """
        if server_time_s < self.server_time_s and self.playing:
            return self
        song_time_s = float(self.song_times_at(server_time_s))
        ended = self._looping is None and song_time_s >= self.duration_s
        return replace(
            self,
            playing=self.playing and not ended,
            song_time_s=song_time_s,
            server_time_s=server_time_s,
            count_in_s=self._count_in_at(server_time_s),
        )

    def server_time_of(self, song_time_s: float) -> float | None:
        """Return the first server time from this state on at which a song time is played; None if never."""
        if not self.playing:
            return self.server_time_s if song_time_s == self.song_time_s else None
        loop = self._looping
        last = loop[1] if loop is not None else self.duration_s
        if self.song_time_s <= song_time_s < last or (loop is None and song_time_s == last):
            return self.server_time_s + (song_time_s - self._begin) / self.rate
        if loop is not None and loop[0] <= song_time_s < self.song_time_s:
            round_s = self.loop_count_in_s + song_time_s - loop[0]
            return self.server_time_s + (loop[1] - self._begin + round_s) / self.rate
        return None

    def spans(self, start_s: float, end_s: float) -> tuple[Span, ...]:
        """Return the song time heard between two server times as runs without a jump, in their order.

        Neighbouring calls meet without a gap: the last span of one ends where the first of the next begins.
        While a count-in is on there is none.
        """
        start_s = max(start_s, self.server_time_s)
        if not self.playing or end_s <= start_s:
            return ()
        run, until = self._begin + (np.array([start_s, end_s]) - self.server_time_s) * self.rate
        first, last = float(run), float(until)
        if first < self.song_time_s:
            first, start_s = self.song_time_s, self.server_time_s + self.count_in_s / self.rate
        loop = self._looping
        if loop is None:
            last = min(last, self.duration_s)
            return (Span(start_s, first, last, last >= self.duration_s),) if last > first else ()
        # As if song time ran on: turn n of the loop is [begin + n round, end + n round), a round being the
        # count-in and the loop, and what comes before the loop belongs to turn 0.
        begin, end = loop
        counted = self.loop_count_in_s
        round_s = counted + end - begin
        turn = max(0, math.floor((first - begin) / round_s))
        spans: list[Span] = []
        while first < last:
            if turn and counted:
                first = max(first, begin + turn * round_s)
            stop = min(last, end + turn * round_s)
            if stop > first:
                server = self.server_time_s + (first - self._begin) / self.rate
                spans.append(Span(server, first - turn * round_s, stop - turn * round_s))
                first = stop
            turn += 1
        return tuple(spans)

    def frames_due(self, start_s: float, end_s: float, fps: int) -> tuple[IntArray, FloatArray]:
        """Return the frames on the grid k / fps that fall due from `start_s` up to, not including, `end_s`.

        Neighbouring calls give each frame once. While paused none is due.

        Returns:
            (F,) int64 frame indices and (F,) float64 server times, in the order of the times.
        """
        frames: list[IntArray] = [np.zeros(0, dtype=np.int64)]
        due: list[FloatArray] = [np.zeros(0)]
        for span in self.spans(start_s, end_s):
            # A millionth of a frame is forgiven, so that a seek to k / fps begins with frame k.
            first, last = (math.ceil(round(time * fps, 6)) for time in (span.start_s, span.end_s))
            if span.ends_song:
                last = math.floor(round(span.end_s * fps, 6)) + 1
            run = np.arange(first, last, dtype=np.int64)
            frames.append(run)
            due.append(span.server_time_s + (run / fps - span.start_s) / self.rate)
        return np.concatenate(frames), np.concatenate(due)


class MusicClock:
    """Play, pause, seek, rate and loop, on an injected clock.

    Song time while playing is ``s0 + (T - T0) · rate``, where s0 was heard at the server time T0 of the last
    change. At the end it stops: the state then says paused at the duration, and playing again begins at 0.
    Every call below raises the epoch, whether it changes anything or not.
    """

    def __init__(self, now: Callable[[], float], duration_s: float) -> None:
        """Make a clock that is paused at 0.

        Args:
            now: The server's time in seconds; it never goes back.
            duration_s: Where the song ends, greater than 0.

        Raises:
            ValueError: If the duration is not greater than 0 and finite.
        """
        if not (math.isfinite(duration_s) and duration_s > 0):
            raise ValueError(f"a song lasts a finite time greater than 0 seconds, not {duration_s}")
        self._now = now
        self._changed = ClockState(False, 0.0, now(), 1.0, None, 0, duration_s)

    @property
    def duration_s(self) -> float:
        """Where the song ends, seconds."""
        return self._changed.duration_s

    @property
    def epoch(self) -> int:
        """How many changes there were."""
        return self._changed.epoch

    def state(self, at: float | None = None) -> ClockState:
        """Return the state at a server time, now by default; it depends on the last change and `at` alone."""
        return self._changed.at(self._now() if at is None else at)

    def resume(self, state: ClockState) -> ClockState:
        """Go on from a state that another clock was in; what of it does not fit this song is let go.

        Args:
            state: Its server time is this clock's, and may lie before this clock was made: song time has run
                since. The epoch here is a greater one. Its duration is not looked at.
        """
        then = self._fitting(state)
        self._changed = replace(then.at(self._now()), epoch=max(state.epoch, self._changed.epoch) + 1)
        return self._changed

    def adopt(self, state: ClockState) -> ClockState:
        """Be in the state that another clock of the same song is in; what does not fit this song is let go.

        Args:
            state: As of `resume`. Its epoch becomes this clock's where it is a greater one; else a greater
                one than this clock's does.
        """
        own = self._changed.epoch
        epoch = state.epoch if state.epoch > own else own + 1
        self._changed = replace(self._fitting(state), epoch=epoch)
        return self._changed

    def fork(self) -> "MusicClock":
        """Another clock in the same state, to try a change with."""
        other = MusicClock(self._now, self.duration_s)
        other._changed = self._changed
        return other

    def _fitting(self, state: ClockState) -> ClockState:
        """A state, with what of it fits this song."""
        duration_s = self.duration_s
        loop = state.loop
        if loop is not None and not (loop[0] >= 0 and loop[0] + SHORTEST_LOOP_S <= loop[1] <= duration_s):
            loop = None
        counted = state.loop_count_in_s if loop else 0.0
        return replace(
            state,
            song_time_s=min(max(state.song_time_s, 0.0), duration_s),
            rate=min(max(state.rate, SLOWEST_RATE), FASTEST_RATE),
            loop=loop,
            loop_count_in_s=min(max(counted, 0.0), LONGEST_COUNT_IN_S),
            count_in_s=min(max(state.count_in_s, 0.0), LONGEST_COUNT_IN_S) if state.playing else 0.0,
            duration_s=duration_s,
        )

    def play(self, count_in_s: float = 0.0) -> ClockState:
        """Let song time run; from the beginning if it stands at the end.

        Args:
            count_in_s: Song seconds that are counted in before: so long it stands, at the rate.

        Raises:
            ClockError: If the count-in is not 0 to 120.
        """
        _check_count_in(count_in_s)
        state = self.state()
        if state.song_time_s >= state.duration_s and not state.playing:
            state = replace(state, song_time_s=0.0)
        # A count-in that is on goes on; only another one takes its place.
        counted = float(count_in_s) or state.count_in_s
        return self._change(replace(state, playing=True, count_in_s=counted))

    def pause(self) -> ClockState:
        """Let song time stand."""
        return self._change(replace(self.state(), playing=False, count_in_s=0.0))

    def seek(self, song_time_s: float) -> ClockState:
        """Go to a song time; what is before the beginning or after the end is taken as that.

        Raises:
            ClockError: If it is not finite.
        """
        if not math.isfinite(song_time_s):
            raise ClockError(f"{song_time_s} is no song time; a number of seconds is", location="song_time_s")
        state = self.state()
        song_time_s = min(max(song_time_s, 0.0), state.duration_s)
        return self._change(replace(state, song_time_s=song_time_s, count_in_s=0.0))

    def set_rate(self, rate: float) -> ClockState:
        """Let song time run faster or slower.

        Raises:
            ClockError: If the rate is outside 0.1 to 4.
        """
        if not SLOWEST_RATE <= rate <= FASTEST_RATE:
            raise ClockError(f"the rate is {SLOWEST_RATE} to {FASTEST_RATE}, not {rate}", location="rate")
        return self._change(replace(self.state(), rate=float(rate)))

    def set_loop(
        self, start_s: float | None, end_s: float | None = None, count_in_s: float = 0.0
    ) -> ClockState:
        """Return to `start_s` whenever `end_s` is reached; without them, play on to the end.

        Args:
            start_s: Where it begins, song seconds.
            end_s: Where it ends.
            count_in_s: Song seconds that are counted in before each further round, song time standing at
                `start_s`.

        Raises:
            ClockError: If it is not inside the song or shorter than 0.1 s, or the count-in is not 0 to 120.
        """
        _check_count_in(count_in_s)
        loop = None
        if start_s is not None and end_s is not None:
            if not 0 <= start_s < end_s <= self.duration_s:
                raise ClockError(
                    f"a loop begins before it ends, within 0 to {self.duration_s:.3f} s, "
                    f"not {start_s} to {end_s}",
                    location="start_s",
                )
            if end_s - start_s < SHORTEST_LOOP_S:
                raise ClockError(f"a loop lasts at least {SHORTEST_LOOP_S} s", location="end_s")
            loop = (float(start_s), float(end_s))
        counted = float(count_in_s) if loop else 0.0
        return self._change(replace(self.state(), loop=loop, loop_count_in_s=counted))

    def touch(self) -> ClockState:
        """Raise the epoch alone: something else that the frames depend on was changed."""
        return self._change(self.state())

    def set_duration(self, duration_s: float) -> ClockState:
        """Change where the song ends; the position and the loop are kept inside it.

        Raises:
            ValueError: If it is not greater than 0 and finite.
        """
        if not (math.isfinite(duration_s) and duration_s > 0):
            raise ValueError(f"a song lasts a finite time greater than 0 seconds, not {duration_s}")
        state = self.state()
        loop = state.loop if state.loop and state.loop[1] <= duration_s else None
        song_time_s = min(state.song_time_s, duration_s)
        counted = state.loop_count_in_s if loop else 0.0
        return self._change(
            replace(
                state,
                song_time_s=song_time_s,
                loop=loop,
                loop_count_in_s=counted,
                duration_s=duration_s,
            )
        )

    def _change(self, state: ClockState) -> ClockState:
        self._changed = replace(state, epoch=self._changed.epoch + 1)
        return self._changed


def _check_count_in(count_in_s: float) -> None:
    if not 0 <= count_in_s <= LONGEST_COUNT_IN_S:
        raise ClockError(
            f"a count-in lasts 0 to {LONGEST_COUNT_IN_S:g} s of the song, not {count_in_s}",
            location="count_in_s",
        )
