"""What a rule decides: a fact with its place and robots, and what follows from it."""

from dataclasses import dataclass

from schemas.game import Card, EventKind
from schemas.side import Side
from sim_host.referee.game.restart import Restart, Spot


@dataclass(frozen=True, slots=True)
class Decision:
    """What a rule has found; the game is stopped, then goes on with the restart, or the half ends."""

    kind: EventKind
    text: str
    """One sentence for people, with the measured quantity."""
    restart: Restart | None = None
    """How the game goes on; nothing when the half ends."""
    goal_for: Side | None = None
    ends_half: bool = False
    shot_scored: bool | None = None
    """The attempt of a shoot-out is over, with a goal or without."""
    side: Side | None = None
    robot: str | None = None
    robots: tuple[str, ...] = ()
    """All robots that it is about, where there are more than one."""
    place: Spot | None = None
    measured: float | None = None
    """The quantity that broke the rule, in `unit`."""
    limit: float | None = None
    unit: str = ""
    card: Card | None = None
    """What `robot` is shown for it."""


@dataclass(frozen=True, slots=True)
class Proposal:
    """A decision that people may still overrule."""

    rule: str
    decision: Decision
    left: float
    """s until it is carried out."""

    @property
    def text(self) -> str:
        """The rule and its sentence."""
        return f"{self.rule}: {self.decision.text}"

    def after(self, dt: float) -> "Proposal":
        """The same `dt` s later."""
        return Proposal(self.rule, self.decision, self.left - dt)
