"""The constants of one match: rule book, pitch, bodies, roster, and the conditions of its start."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from schemas.config.roster import goalkeeper_of
from schemas.config.sections import Ball, Pitch
from schemas.config.soccer.rule_book import RuleBook
from schemas.errors import TouchlineError
from schemas.frames import Pose
from schemas.side import Side
from schemas.soccer.game import OfficiatingMode
from sim_host.snapshot import Roster


@dataclass(frozen=True, slots=True)
class MatchConstants:
    """The constants of one match."""

    book: RuleBook
    pitch: Pitch
    ball: Ball
    roster: Roster
    half_duration: float
    """Playing time of one half in s."""
    kick_off: Side
    """The side that kicks off the first half."""
    automatic: bool
    """The match begins by itself; otherwise it waits for the action `start`."""
    starts: Mapping[str, Pose]
    """Start pose of each robot in the field frame, for cyan attacking +x."""
    mode: OfficiatingMode = OfficiatingMode.AUTOMATIC
    """Whether the referee, people, or both decide."""
    proposal: float = 0.0
    """s that people have to overrule a decision, in mixed officiating."""
    needs_winner: bool = False
    """A level match goes on with extra time and a shoot-out."""
    advantage: float = 0.0
    """s for which play goes on after a foul for a side that keeps the ball; 0: no advantage."""
    reaches: tuple[float, ...] = field(init=False)
    """m; distance from the centre of each robot of the roster to the farthest point of its hull."""
    out_x: float = field(init=False)
    """m; a ball whose centre is beyond this |x| is wholly over the goal line."""
    out_y: float = field(init=False)
    """m; a ball whose centre is beyond this |y| is wholly over the touch line."""
    deep_x: float = field(init=False)
    """m; the penalty areas are beyond this |x|."""
    near_squared: tuple[float, ...] = field(init=False)
    """m²; squared distance of the centres within which each robot is at the ball, in the order of the roster."""
    widest_near: float = field(init=False)
    """m; no robot is at the ball if it is farther from it along x."""
    all_keepers: tuple[bool, ...] = field(init=False)
    """Whether each robot of the roster keeps its side's goal while all robots are on the field."""

    @property
    def extra_half_duration(self) -> float:
        """Playing time of one half of extra time in s: the book's, scaled as the regular halves are."""
        periods = self.book.periods
        return periods.extra_half_duration * self.half_duration / periods.half_duration

    def __post_init__(self) -> None:
        missing = [name for name in self.roster.names if name not in self.starts]
        if missing:
            raise TouchlineError(f"no start pose for {', '.join(missing)}; every robot of the match needs one")
        object.__setattr__(self, "reaches", tuple([model.body.reach for model in self.roster.models]))
        object.__setattr__(self, "out_x", self.pitch.goal_line + self.ball.radius)
        object.__setattr__(self, "out_y", self.pitch.touch_line + self.ball.radius)
        object.__setattr__(self, "deep_x", self.pitch.goal_line - self.pitch.penalty_area_depth)
        near = self.ball.radius + self.book.scrum.reach
        object.__setattr__(self, "near_squared", tuple([(reach + near) ** 2 for reach in self.reaches]))
        object.__setattr__(self, "widest_near", max(self.reaches, default=0.0) + near)
        object.__setattr__(self, "all_keepers", self._keepers(()))

    def keepers(self, away: Collection[str]) -> tuple[bool, ...]:
        """Whether each robot of the roster keeps its side's goal while the robots in `away` are off the field."""
        return self._keepers(away) if away else self.all_keepers

    def _keepers(self, away: Collection[str]) -> tuple[bool, ...]:
        roster = self.roster
        keepers = [
            goalkeeper_of([name for name in roster.names if roster.side_of(name) is side], away)
            for side in Side
            if side in roster.keepers
        ]
        return tuple([name in keepers for name in roster.names])
