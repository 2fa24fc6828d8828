"""What the recorder itself reads of what it records: how far the match is, its score, its phase."""

from collections import Counter
from collections.abc import Callable, Iterable
from typing import Any

from schemas.bus.contract import Received
from schemas.game import EventKind, GameEvent, GameState, Phase
from schemas.host import Applied, Health
from schemas.message import BadMessageError
from schemas.roster import RosterEntry
from schemas.topics import APPLIED, EVENT, HEALTH, STATE

_ROSTER = b'"robots":['
"""In the inputs of a tick in which others take part than before."""


class MatchNotes:
    """Follows a match by a few of its messages; one that cannot be read is counted and passed over."""

    def __init__(self) -> None:
        self.applied: Applied | None = None
        self.state: GameState | None = None
        self.goals = 0
        self.unreadable: Counter[str] = Counter()
        """Payloads that could not be read, by key."""
        self._newest_applied: Received | None = None
        self._roster: Callable[[list[RosterEntry]], None] = _nobody
        self._joined_at_tick = -1
        self._notes = {
            APPLIED.key: self._note_applied,
            STATE.key: self._note_state,
            EVENT.key: self._note_event,
            HEALTH.key: self._note_health,
        }

    @property
    def tick(self) -> int:
        """The newest tick whose inputs were taken in; −1 before the first.

        A recorder that joins late starts from where the host is: it is not behind by all that was before it came.
        """
        return self.applied.tick if self.applied is not None else self._joined_at_tick

    def tick_at(self, sim_ns: int) -> int:
        """The newest tick whose inputs were taken in and which had begun at this simulated time, in ns."""
        applied = self.applied
        if applied is None or applied.tick <= 0 or applied.time <= 0.0:
            return self.tick
        behind_s = applied.time - sim_ns * 1e-9
        return applied.tick - max(0, round(behind_s * applied.tick / applied.time))

    @property
    def finished(self) -> bool:
        """The match was played to its end."""
        return self.state is not None and self.state.phase is Phase.FULL_TIME

    def follow_roster(self, follow: Callable[[list[RosterEntry]], None]) -> None:
        """Tell `follow` who takes part, whenever that has changed."""
        self._roster = follow

    def take(self, messages: Iterable[Received]) -> None:
        """Look at messages; most are none of ours."""
        notes = self._notes
        for received in messages:
            note = notes.get(received.key)
            if note is not None:
                note(received)

    def catch_up(self) -> None:
        """Read the newest inputs that were taken: once for many ticks, for speed."""
        if self._newest_applied is not None:
            self.applied = self.read(self._newest_applied) or self.applied
            self._newest_applied = None

    def read(self, received: Received) -> Any:
        """The message, or nothing."""
        try:
            return received.message()
        except BadMessageError:
            self.unreadable[received.key] += 1
            return None

    def _note_applied(self, received: Received) -> None:
        self._newest_applied = received
        if _ROSTER in received.payload:
            applied: Applied | None = self.read(received)
            self._roster(applied.robots or [] if applied is not None else [])

    def _note_state(self, received: Received) -> None:
        self.state = self.read(received) or self.state

    def _note_event(self, received: Received) -> None:
        event: GameEvent | None = self.read(received)
        if event is not None and event.kind is EventKind.GOAL:
            self.goals += 1

    def _note_health(self, received: Received) -> None:
        if self.applied is None and self._newest_applied is None and self._joined_at_tick < 0:
            health: Health | None = self.read(received)
            self._joined_at_tick = health.tick if health is not None else -1


def _nobody(robots: list[RosterEntry]) -> None:
    """Nobody wants to know."""
