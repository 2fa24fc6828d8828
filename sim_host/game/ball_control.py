"""What a game needs in the world: its furniture, and what moves the ball."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from schemas.config.profile import Profile
from schemas.config.robot_model import RobotModel
from schemas.messages.applied import AppliedInput
from sim_host.physics.body_state import BodyState
from sim_host.physics.pitch import SOCCER, Furniture
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState

if TYPE_CHECKING:  # a command that checks a match file runs without PyBullet
    from sim_host.physics.engine import Engine


GameBall = Any
"""`sim_host.snapshot.BallState`, or None in a game without a ball; a control is asked with what its own game has."""


@dataclass(slots=True)
class BallReport:
    """Kicks and touches of the ball in one tick; robots by their index in the roster."""

    refused: dict[int, str] = field(default_factory=dict)
    """Robot → why its kick could not be carried out."""
    touches: list[int] = field(default_factory=list)
    """In the order of time."""
    level: tuple[int, ...] = ()
    """The last robots of them, if several were equally late and pressed equally hard."""
    kicked: int | None = None


class BallControl(Protocol):
    """What moves the ball over one tick, and what robots do with it."""

    holder: int | None
    """Index of the robot that holds the ball."""

    def set_holder(self, index: int | None) -> None:
        """Make a robot the holder of the ball, or no robot."""

    def reset(self, ball: GameBall) -> None:
        """Make a checkpoint: forget all but the ball's place and velocity."""

    def kickers_ready(self, tick: int) -> tuple[bool, ...]:
        """Per robot: its kicker can kick in this tick."""

    def decide_possession_and_kick(
        self, tick: int, robots: tuple[RobotState, ...], ball: GameBall, inputs: Sequence[AppliedInput]
    ) -> BallReport:
        """Decide possession and carry out kicks, at the beginning of a tick."""

    def before_step(self, drives: Sequence[FieldTwist]) -> BodyState | None:
        """Move the ball before a physics step; the state of a free ball, None for a held one."""

    def after_step(self, report: BallReport) -> None:
        """Note the touches of this step."""

    def release_lost_ball(self, robots: tuple[RobotState, ...], ball: GameBall) -> bool:
        """At the end of a tick, release a ball that has left its holder; returns whether it was released."""


class Arena(NamedTuple):
    """What a game needs in the world; unlike its judge, it needs no numbers but the profile's."""

    ball_control: "MakeBallControl"
    furniture: Furniture = SOCCER


MakeBallControl = Callable[[Profile, Sequence[RobotModel], "Engine"], BallControl]
