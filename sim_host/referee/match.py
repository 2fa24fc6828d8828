"""What stays the same through one match: rule book, pitch, bodies, who plays, and how it begins."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from schemas.errors import TouchlineError
from schemas.frames import Pose
from schemas.profile import Ball, Field
from schemas.rule_book import RuleBook
from schemas.side import Side
from sim_host.snapshot import Roster


@dataclass(frozen=True, slots=True)
class Match:
    """The constants of one match."""

    book: RuleBook
    pitch: Field
    ball: Ball
    roster: Roster
    half_duration: float
    """Playing time of one half in s."""
    kick_off: Side
    """Who kicks off the first half."""
    automatic: bool
    """The match begins by itself; otherwise it waits for the action `start`."""
    starts: Mapping[str, Pose]
    """Start pose of each robot in the field frame, for cyan attacking +x."""
    reaches: tuple[float, ...] = field(init=False)
    """m; how far each robot of the roster reaches from its centre."""
    out_x: float = field(init=False)
    """m; a ball whose centre is beyond this |x| is wholly over the goal line."""
    out_y: float = field(init=False)
    """m; a ball whose centre is beyond this |y| is wholly over the touch line."""

    def __post_init__(self) -> None:
        missing = [name for name in self.roster.names if name not in self.starts]
        if missing:
            raise TouchlineError(f"no start pose for {', '.join(missing)}; every robot of the match needs one")
        object.__setattr__(self, "reaches", tuple([model.body.reach for model in self.roster.models]))
        object.__setattr__(self, "out_x", self.pitch.goal_line + self.ball.radius)
        object.__setattr__(self, "out_y", self.pitch.touch_line + self.ball.radius)
