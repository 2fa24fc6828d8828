"""Steps of a paused match, which end when their last tick has been published."""

from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple

from robot_agent.ros2.simulation.codes import Code, RefusedError
from robot_agent.ros2.simulation.match_client import MatchClient
from runtime.process.clock import Clock
from runtime.process.timing import REPLY_S
from schemas.messages.pace import PaceOperation


class Outcome(NamedTuple):
    """How steps ended."""

    code: Code
    reason: str = ""
    is_canceled: bool = False


class Steps:
    """The steps of one request, from which others are refused until they end."""

    def __init__(self, match: MatchClient, clock: Clock, ticks: int, end: Callable[[Outcome], None]) -> None:
        """Begin so many ticks; `end` is called once, when they end.

        Raises:
            RefusedError: the match is not paused, or this is no number of ticks.
        """
        self._match, self._clock, self._end = match, clock, end
        self.is_canceled = False
        """Somebody wants them to end."""
        if ticks < 1:
            raise RefusedError(Code.FAILED, f"steps is {ticks}; ask for 1 or more ticks")
        reply = match.pace(PaceOperation.STEP, ticks)
        if not reply.accepted:
            raise RefusedError(Code.FAILED, reply.reason)
        self._first, self._until = reply.tick, reply.tick + ticks
        self._asked_at = clock.now()

    def cancel(self) -> None:
        """Pause the match now; they end when it is, or when its host does not reply."""
        self.is_canceled = True
        with suppress(RefusedError):
            self._match.pace(PaceOperation.PAUSE)

    def follow(self, timeout: float) -> tuple[int, int] | None:
        """Wait up to `timeout` s for another tick; ticks that are done and that are left; None once they have ended."""
        world = self._match.world(timeout)
        tick = max(self._first, world.tick if world is not None else 0)
        if tick >= self._until:
            self._end(Outcome(Code.OK))
            return None
        if self.is_canceled or self._clock.now() - self._asked_at >= REPLY_S:
            self._asked_at = self._clock.now()
            outcome = self._outcome()
            if outcome is not None:
                self._end(outcome)
                return None
        return tick - self._first, self._until - tick

    def _outcome(self) -> Outcome | None:
        """How they have ended by the word of the host; None while they go on."""
        try:
            reply = self._match.pace(PaceOperation.SHOW)
        except RefusedError as error:
            return Outcome(error.code, str(error))
        if reply.tick >= self._until:
            return Outcome(Code.OK)
        if self.is_canceled and reply.paused:
            return Outcome(Code.FAILED, f"canceled at tick {reply.tick}", is_canceled=True)
        if not reply.accepted or reply.until != self._until:
            return Outcome(Code.FAILED, f"they were ended at tick {reply.tick} by somebody else")
        return None
