"""What a recorder follows of a match: time, phase, score and roster, and the messages that stay valid."""

from collections import Counter
from collections.abc import Callable, Iterable
from typing import Any

from recordings.container.applied_changes import changes_in
from recordings.container.manifest import EndReason, KeyCount, Result
from schemas.bus.contract import ReceivedMessage
from schemas.config.roster import RosterEntry
from schemas.game import EventKind, Phase
from schemas.messages.applied import Applied
from schemas.messages.game import GameEvent, GameState
from schemas.topics import ACTIVE_ORDER, APPLIED, EVENT, ORDER, STATE, WORLD
from schemas.wire.message import BadMessageError

LoggedMessage = tuple[int, ReceivedMessage]
"""Log time in ns, and message."""

_LATCHED_KEYS = frozenset({WORLD.key, STATE.key, ORDER.key, ACTIVE_ORDER.key, APPLIED.key})
"""Topics whose newest message is valid until the next one on its key."""


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
        self._handlers = {
            APPLIED.key: self._on_applied,
            STATE.key: self._on_state,
            EVENT.key: self._on_event,
        }

    @property
    def finished(self) -> bool:
        """The match was played to its end."""
        return self.state is not None and self.state.phase is Phase.FULL_TIME

    def update(self, messages: Iterable[ReceivedMessage]) -> None:
        """Process messages; most are of other topics."""
        handlers = self._handlers
        for received in messages:
            handler = handlers.get(received.key)
            if handler is not None:
                handler(received)

    def catch_up(self) -> None:
        """Decode the newest inputs: once for many ticks, for speed."""
        if self._newest_applied is not None:
            self.applied = self.read(self._newest_applied) or self.applied
            self._newest_applied = None

    def result(self, ended: EndReason, finished: str, keys: dict[str, KeyCount]) -> Result:
        """The result of a recording with these counts that ends now; `finished` is the wall time."""
        state, applied = self.state, self.applied
        result = Result(
            ended=ended,
            finished=finished,
            phase=state.phase if state is not None else None,
            score=state.score if state is not None else None,
            clock=state.clock if state is not None else 0.0,
            tick=applied.tick if applied is not None else -1,
            time=applied.time if applied is not None else 0.0,
        )
        return result.counted(keys)

    def read(self, received: ReceivedMessage) -> Any:
        """The message, or None if it is invalid."""
        try:
            return received.message()
        except BadMessageError:
            self.unreadable[received.key] += 1
            return None

    def _on_applied(self, received: ReceivedMessage) -> None:
        self._newest_applied = received
        if changes_in(received.payload).robots is not None:
            applied: Applied | None = self.read(received)
            self.roster_changed(applied.robots or [] if applied is not None else [])

    def _on_state(self, received: ReceivedMessage) -> None:
        self.state = self.read(received) or self.state

    def _on_event(self, received: ReceivedMessage) -> None:
        event: GameEvent | None = self.read(received)
        if event is not None and event.kind is EventKind.GOAL:
            self.goals += 1


class LatchedMessages:
    """The latched messages at a time: the newest world, and the newest of each topic sent on change only.

    A file that begins in the middle of a match begins with them, so that it can be read without the files before it.
    """

    def __init__(self) -> None:
        self._newest: dict[str, LoggedMessage] = {}
        self._changes: list[LoggedMessage] = []
        """Messages `host/applied` with lasting changes; all of them remain valid."""

    def update(self, batch: Iterable[LoggedMessage]) -> None:
        """Add messages."""
        newest = self._newest
        for logged in batch:
            received = logged[1]
            row = received.topic.key
            if row not in _LATCHED_KEYS:
                continue
            if row == APPLIED.key:
                before = newest.get(received.key)
                if before is not None and changes_in(before[1].payload):
                    self._changes.append(before)
            newest[received.key] = logged

    def messages(self) -> list[LoggedMessage]:
        """The latched messages with their log times, oldest first."""
        return sorted([*self._changes, *self._newest.values()], key=lambda logged: logged[0])
