"""The penalty shoot-out as the referee remembers it: kicks and goals of each side, and the attempt that is on."""

from dataclasses import dataclass, field

from schemas.game import Score
from schemas.side import Side


@dataclass(frozen=True, slots=True)
class ShootOut:
    """Where a shoot-out stands."""

    first: Side
    """Who began."""
    series: int = 1
    taken: Score = field(default_factory=Score)
    """Penalties taken in this series."""
    goals: Score = field(default_factory=Score)
    """Of all series."""
    nearest: float | None = None
    """m; of this attempt, the nearest that the ball came to the goal line while the kicker had it."""

    def after_attempt(self, side: Side, scored: bool) -> "ShootOut":
        """After one more attempt of a side."""
        goals = self.goals.plus(side) if scored else self.goals
        return ShootOut(self.first, self.series, self.taken.plus(side), goals)

    def next_series(self) -> "ShootOut":
        """Another series, which the other side begins."""
        return ShootOut(self.first.opponent, self.series + 1, Score(), self.goals)

    def next_side(self) -> Side:
        """Who takes the next penalty: sides alternate."""
        return self.first if self.taken.of(self.first) == self.taken.of(self.first.opponent) else self.first.opponent

    def leader(self, kicks: int) -> Side | None:
        """Who cannot be caught up with any more when each side has so many penalties; nothing while it is open."""
        for side in Side:
            ahead = self.goals.of(side) - self.goals.of(side.opponent)
            if ahead > kicks - self.taken.of(side.opponent):
                return side
        return None

    def is_played(self, kicks: int) -> bool:
        """Whether both sides have taken all penalties of this series."""
        return min(self.taken.cyan, self.taken.magenta) >= kicks
