"""The state of a penalty shoot-out: kicks and goals of each side, and the present attempt."""

from dataclasses import dataclass, field

from schemas.side import Side
from schemas.soccer.game import Score


@dataclass(frozen=True, slots=True)
class ShootOut:
    """The state of a shoot-out."""

    first: Side
    """The side that began this series."""
    series: int = 1
    taken: Score = field(default_factory=Score)
    """Penalties taken in this series."""
    goals: Score = field(default_factory=Score)
    """Goals of all series."""
    nearest: float | None = None
    """m; in this attempt, the smallest distance of the ball from the goal line while the kicker held it."""

    def after_attempt(self, side: Side, scored: bool) -> "ShootOut":
        """The shoot-out after one more attempt of a side."""
        goals = self.goals.plus(side) if scored else self.goals
        return ShootOut(self.first, self.series, self.taken.plus(side), goals)

    def next_series(self) -> "ShootOut":
        """The next series, which the other side begins."""
        return ShootOut(self.first.opponent, self.series + 1, Score(), self.goals)

    def next_side(self) -> Side:
        """The side that takes the next penalty; sides alternate."""
        return self.first if self.taken.of(self.first) == self.taken.of(self.first.opponent) else self.first.opponent

    def leader(self, kicks: int) -> Side | None:
        """The side that cannot be caught up with, if each side has this number of penalties; None while it is open."""
        for side in Side:
            ahead = self.goals.of(side) - self.goals.of(side.opponent)
            if ahead > kicks - self.taken.of(side.opponent):
                return side
        return None

    def is_played(self, kicks: int) -> bool:
        """Whether both sides have taken all penalties of this series."""
        return min(self.taken.cyan, self.taken.magenta) >= kicks
