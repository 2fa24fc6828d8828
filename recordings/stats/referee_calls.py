"""What the referee called: goals, fouls, cards, restarts, and the score that he keeps."""

from collections import Counter
from dataclasses import dataclass

from recordings.stats.match_tick import MatchTick
from schemas.game import RESTARTS, Card, EventKind, GameEvent, GameState, Phase, Score
from schemas.side import Side


@dataclass(frozen=True, slots=True)
class Goal:
    """One goal; s."""

    time: float
    clock: float
    side: Side | None
    """Whose it is."""
    robot: str | None
    """Who touched the ball last."""


class RefereeCalls:
    """Counts over events and states."""

    def __init__(self) -> None:
        self.goals: list[Goal] = []
        self.score: Score | None = None
        """As the referee has it; nothing where he never said."""
        self.fouls: Counter[tuple[Side | None, str]] = Counter()
        """By side of the offender and rule."""
        self.fouls_of: Counter[str] = Counter()
        """By offender."""
        self.cards: Counter[tuple[Side | None, Card]] = Counter()
        self.cards_of: Counter[tuple[str, Card]] = Counter()
        self.restarts: Counter[tuple[Side | None, Phase]] = Counter()
        """By the side that takes them; a restart that is signalled again counts again."""
        self.events: list[GameEvent] = []

    def update(self, match_tick: MatchTick) -> None:
        """One more tick."""
        for event in match_tick.events:
            self._event(event)
        now, before = match_tick.state, match_tick.state_before
        if now is None:
            return
        self.score = now.score
        if now is not before and _is_signalled(before, now):
            self.restarts[now.side, now.phase] += 1

    def _event(self, event: GameEvent) -> None:
        self.events.append(event)
        if event.kind is EventKind.GOAL:
            self.goals.append(Goal(event.time, event.clock, event.side, event.robot))
        elif event.kind is EventKind.FOUL:
            self.fouls[event.side, event.rule] += 1
            self.fouls_of.update([event.robot] if event.robot is not None else [])
        elif event.kind is EventKind.CARD and event.card is not None:
            self.cards[event.side, event.card] += 1
            self.cards_of.update([(event.robot, event.card)] if event.robot is not None else [])


def _is_signalled(before: GameState | None, now: GameState) -> bool:
    """A restart is signalled; the state is said once a second, and START changes it too."""
    if now.phase not in RESTARTS or now.running:
        return False
    return before is None or before.running or (before.phase, before.side) != (now.phase, now.side)
