"""What a recorder follows of a match: time, phase, score and roster."""

from collections import Counter
from collections.abc import Callable
from typing import Any

from recordings.container.applied_changes import changes_in
from recordings.container.manifest import EndReason, KeyCount, Result
from runtime.bus.contract import ReceivedMessage
from schemas.config.roster import RosterEntry
from schemas.messages.applied import Applied
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.soccer.game import EventKind, Phase
from schemas.topics import APPLIED, EVENT, STATE
from schemas.wire.message import BadMessageError

FOLLOWED = frozenset({APPLIED.key, STATE.key, EVENT.key})
"""The keys whose messages it is told of; all others are none of its business."""


class MatchProgress:
    """Follows a match by a few of its messages; an invalid one is counted and skipped."""

    def __init__(self) -> None:
        self.applied: Applied | None = None
        self.state: GameState | None = None
        self.goals = 0
        self.unreadable: Counter[str] = Counter()
        """Key → payloads that could not be read."""
        self._newest_applied: ReceivedMessage | None = None
        self.roster_changed: Callable[[list[RosterEntry]], None] = lambda _: None
        """Called with the new roster at each change."""

    @property
    def finished(self) -> bool:
        """The match was played to its end."""
        return self.state is not None and self.state.phase is Phase.FULL_TIME

    def update(self, received: ReceivedMessage) -> None:
        """Process a message on a followed key."""
        if received.topic is APPLIED:
            self._newest_applied = received
            if changes_in(received.payload).robots is not None:
                applied: Applied | None = self.read(received)
                self.roster_changed(applied.robots or [] if applied is not None else [])
        elif received.topic is STATE:
            self.state = self.read(received) or self.state
        else:
            event: GameEvent | None = self.read(received)
            self.goals += event is not None and event.kind is EventKind.GOAL

    def catch_up(self) -> None:
        """Decode the newest inputs: once for many ticks, for speed."""
        if self._newest_applied is not None:
            self.applied = self.read(self._newest_applied) or self.applied
            self._newest_applied = None

    def result(self, ended: EndReason, finished: str, keys: dict[str, KeyCount]) -> Result:
        """The result of a recording with these counts that ends now; `finished` is the wall time."""
        state, applied = self.state, self.applied
        result = Result(ended=ended, finished=finished)
        if state is not None:
            result = result.replace(phase=state.phase, score=state.score, value=state.value, clock=state.clock)
        if applied is not None:
            result = result.replace(tick=applied.tick, time=applied.time)
        return result.counted(keys)

    def read(self, received: ReceivedMessage) -> Any:
        """The message, or None if it is invalid."""
        try:
            return received.message()
        except BadMessageError:
            self.unreadable[received.key] += 1
            return None
