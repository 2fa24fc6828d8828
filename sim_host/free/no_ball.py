"""The ball of a game without one: nothing moves, and a kick is refused."""

from collections.abc import Sequence

from schemas.config.profile import Profile
from schemas.config.robot_model import RobotModel
from schemas.messages.applied import AppliedInput
from sim_host.game.ball_control import BallReport
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import RobotState


class NoBall:
    """A `sim_host.game.ball_control.BallControl`."""

    holder: int | None = None

    def __init__(self, _profile: Profile, models: Sequence[RobotModel], _engine: object) -> None:
        self._none_ready = (False,) * len(models)

    def set_holder(self, index: int | None) -> None:
        """No robot holds what is not there."""

    def reset(self, ball: None) -> None:
        """There is nothing to forget."""

    def kickers_ready(self, _tick: int) -> tuple[bool, ...]:
        """No kicker is ready."""
        return self._none_ready

    def decide_possession_and_kick(
        self, _tick: int, _robots: tuple[RobotState, ...], _ball: None, inputs: Sequence[AppliedInput]
    ) -> BallReport:
        """Refuse kicks."""
        return BallReport(refused={i: "the game has no ball" for i, one in enumerate(inputs) if one.kick is not None})

    def before_step(self, _drives: Sequence[FieldTwist]) -> None:
        """Move nothing."""

    def after_step(self, report: BallReport) -> None:
        """Note nothing."""

    def release_lost_ball(self, _robots: tuple[RobotState, ...], _ball: None) -> bool:
        """Nothing is lost."""
        return False
