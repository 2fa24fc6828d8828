"""Calls of the referee: goals, fouls, cards, restarts, and the score."""

from collections import Counter
from dataclasses import dataclass

from recordings.soccer.stats.match_tick import MatchTick
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.side import Side
from schemas.soccer.game import RESTARTS, Card, EventKind, Phase, Score


@dataclass(frozen=True, slots=True)
class ScoredGoal:
    """One goal; times in s."""

    time: float
    clock: float
    side: Side | None
    """The scoring side."""
    robot: str | None
    """The last robot to touch the ball."""


class RefereeCalls:
    """Counts events and changes of the game state."""

    def __init__(self) -> None:
        self.goals: list[ScoredGoal] = []
        self.score: Score | None = None
        """The referee's score; None if no game state was recorded."""
        self.shoot_out: Score | None = None
        """Goals of the penalty shoot-out; None without one."""
        self.fouls: Counter[tuple[Side | None, str]] = Counter()
        """Offending side and rule → fouls."""
        self.fouls_of: Counter[str] = Counter()
        """Offending robot → fouls."""
        self.cards: Counter[tuple[Side | None, Card]] = Counter()
        self.cards_of: Counter[tuple[str, Card]] = Counter()
        self.restarts: Counter[tuple[Side | None, Phase]] = Counter()
        """Side that takes the restart and phase → restarts; each signal counts."""
        self.events: list[GameEvent] = []

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick."""
        for event in match_tick.events:
            self._event(event)
        now, before = match_tick.state, match_tick.state_before
        if now is None:
            return
        self.score, self.shoot_out = now.score, now.shoot_out
        if now is not before and _is_signalled(before, now):
            self.restarts[now.side, now.phase] += 1

    def _event(self, event: GameEvent) -> None:
        self.events.append(event)
        if event.kind is EventKind.GOAL:
            self.goals.append(ScoredGoal(event.time, event.clock, event.side, event.robot))
        elif event.kind is EventKind.FOUL:
            self.fouls[event.side, event.rule] += 1
            self.fouls_of.update([event.robot] if event.robot is not None else [])
        elif event.kind is EventKind.CARD and event.card is not None:
            self.cards[event.side, event.card] += 1
            self.cards_of.update([(event.robot, event.card)] if event.robot is not None else [])


def _is_signalled(before: GameState | None, now: GameState) -> bool:
    """Whether a new game state signals a restart; it may also be the periodic repetition, or START."""
    if now.phase not in RESTARTS or now.running:
        return False
    return before is None or before.running or (before.phase, before.side) != (now.phase, now.side)
