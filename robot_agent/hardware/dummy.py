"""Hardware for tests: an ideal body in memory, with faults on demand."""

from collections.abc import Mapping

from robot_agent.hardware.contract import BodyBall, Picture, SensorReadings
from schemas.config.robot_model import RobotModel
from schemas.frames import Pose, rotate, to_body, wrap
from schemas.messages.command import Drive, Kick
from schemas.messages.radio import Motion
from schemas.messages.sight import Obstacle


class Dummy:
    """A body that does at once what it is told, on an empty floor with a ball and posts that stand still."""

    def __init__(
        self,
        model: RobotModel,
        *,
        start: tuple[float, float, float] = (0.0, 0.0, 0.0),
        ball: tuple[float, float] | None = None,
        posts: tuple[tuple[float, float], ...] = (),
        faults: Mapping[str, str] = {},
    ) -> None:
        """A body at a pose `start`, with ball and posts in the field frame, all in m and rad.

        `faults`: name of a method → text of the `OSError` that it raises.
        """
        self.calls: list[str] = []
        """The methods that were called, but for `sense` and `actuate`."""
        self.kicks: list[Kick] = []
        self.dribbles = False
        self.drive: Drive | None = None
        """The newest demand; None before the first, and while the motors have no power."""
        self.faults = dict(faults)
        self._model, self._ball, self._posts = model, ball, posts
        self._pose, self._time = Pose(*start), 0.0

    def configure(self) -> None:
        """Nothing to open."""
        self._note("configure")

    def activate(self) -> None:
        """Nothing to power."""
        self._note("activate")

    def sense(self, time: float) -> SensorReadings:
        """The exact pose, and a picture without delay."""
        self._check("sense")
        self._move(time)
        pose, drive = self._pose, self.drive or Drive()
        vx, vy = rotate(drive.vx, drive.vy, pose.heading)
        motion = Motion(x=pose.x, y=pose.y, heading=pose.heading, vx=vx, vy=vy, omega=drive.omega)
        ball = BodyBall(*self._seen(*self._ball)) if self._ball is not None else None
        posts = tuple(Obstacle(*self._seen(*post), self._model.body.radius) for post in self._posts)
        return SensorReadings(time, motion, Picture(time, ball, posts))

    def actuate(self, drive: Drive | None, kick: Kick | None, dribble: bool) -> None:
        """Take over a demand."""
        self._check("actuate")
        self.drive, self.dribbles = drive, dribble
        if kick is not None:
            self.kicks.append(kick)

    def deactivate(self) -> None:
        """Stop."""
        self.drive = None
        self._note("deactivate")

    def close(self) -> None:
        """Nothing to close."""
        self._note("close")

    def _move(self, time: float) -> None:
        pose, drive, dt = self._pose, self.drive or Drive(), time - self._time
        x, y = rotate(drive.vx, drive.vy, pose.heading)
        self._pose = Pose(pose.x + x * dt, pose.y + y * dt, wrap(pose.heading + drive.omega * dt))
        self._time = time

    def _seen(self, x: float, y: float) -> tuple[float, float]:
        return to_body(x - self._pose.x, y - self._pose.y, self._pose.heading)

    def _note(self, name: str) -> None:
        self.calls.append(name)
        self._check(name)

    def _check(self, name: str) -> None:
        if name in self.faults:
            raise OSError(self.faults[name])
