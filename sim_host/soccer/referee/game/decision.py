"""The decision of a rule: a fact with its place and robots, and its consequences."""

from dataclasses import dataclass

from schemas.side import Side
from schemas.soccer.game import Card, EventKind
from sim_host.soccer.referee.game.restart import Restart, Spot


@dataclass(frozen=True, slots=True)
class Decision:
    """A decision: the game is stopped and goes on with a restart, or the half ends."""

    kind: EventKind
    text: str
    """One sentence for people, with the measured quantity."""
    restart: Restart | None = None
    """How the game goes on; None when the half ends."""
    goal_for: Side | None = None
    ends_half: bool = False
    shot_scored: bool | None = None
    """Whether an attempt of a shoot-out has ended with a goal; None if none has ended."""
    side: Side | None = None
    robot: str | None = None
    robots: tuple[str, ...] = ()
    """All robots that are involved, if more than one."""
    place: Spot | None = None
    measured: float | None = None
    """The quantity that broke the rule, in `unit`."""
    limit: float | None = None
    unit: str = ""
    card: Card | None = None
    """The card that `robot` is shown."""


@dataclass(frozen=True, slots=True)
class Proposal:
    """A decision that people may overrule."""

    rule: str
    decision: Decision
    left: float
    """s until it is carried out."""

    @property
    def text(self) -> str:
        """The name of the rule and the text of its decision."""
        return f"{self.rule}: {self.decision.text}"

    def after(self, dt: float) -> "Proposal":
        """The proposal `dt` s later."""
        return Proposal(self.rule, self.decision, self.left - dt)
