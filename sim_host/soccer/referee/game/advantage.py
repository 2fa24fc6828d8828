"""An advantage: a foul after which play goes on, as long as the side that suffered it keeps the ball."""

from dataclasses import dataclass

from schemas.side import Side
from sim_host.soccer.referee.game.decision import Decision


@dataclass(frozen=True, slots=True)
class Advantage:
    """A foul that has been noted, and not yet decided."""

    rule: str
    decision: Decision
    """The decision on the foul, which is carried out if the side loses the ball."""
    side: Side
    """The side that suffered the foul."""
    left: float
    """s until the advantage has been used."""

    def after(self, dt: float) -> "Advantage":
        """The advantage `dt` s later."""
        return Advantage(self.rule, self.decision, self.side, self.left - dt)
