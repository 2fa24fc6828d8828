"""The hardware `replayed`: the readings of a robot in a recording, as often as a brain is to be tried on them."""

import math
from bisect import bisect_right
from pathlib import Path

from robot_agent.hardware.contract import BodyBall, Picture, SensorReadings
from schemas.config.robot_model import RobotModel
from schemas.frames import Pose, to_body
from schemas.messages.command import Drive, Kick
from schemas.messages.radio import Motion
from schemas.messages.sight import Obstacle, Sight
from touchline.hardware.robot_track import pose_of, read_track


class Replayed:
    """Senses what a robot sensed in a recording, and moves nothing."""

    def __init__(self, _model: RobotModel, *, recording: str, robot: str, attacks: int = 1) -> None:
        """Read the recording.

        Args:
            _model: the model of the robot that replays.
            recording: path of the file.
            robot: name of the robot in it.
            attacks: 1 if its team attacked +x of the field, -1 otherwise.

        Raises:
            TouchlineError: the file cannot be read, or has no sights of this robot.
        """
        track = read_track(Path(recording), robot)
        self._sights, self._attacks = track.sights, attacks
        self._times = [sight.time - track.sights[0].time for sight in track.sights]
        self._picture = -math.inf
        """When the newest picture was taken that was returned, s."""

    def configure(self) -> None:
        """Nothing to open."""

    def activate(self) -> None:
        """Nothing to power."""

    def sense(self, time: float) -> SensorReadings:
        """The readings of this time, counted from the first sight of the recording.

        Raises:
            EOFError: the recording has ended.
        """
        if time > self._times[-1]:
            raise EOFError(f"the recording has ended after {self._times[-1]:.2f} s")
        place = max(0, bisect_right(self._times, time + 1e-6) - 1)  # times are sums of ticks
        sight, pose = self._sights[place], pose_of(self._sights[place]).team(self._attacks)
        motion = Motion(
            x=pose.x,
            y=pose.y,
            heading=pose.heading,
            vx=self._attacks * sight.self.vx,
            vy=self._attacks * sight.self.vy,
            omega=sight.self.omega,
        )
        picture = self._new_picture(self._times[place] - sight.obstacles_age, sight)
        sensors = {name: reading for name, reading in sight.sensors.items() if reading.age == 0.0}
        return SensorReadings(
            self._times[place], motion, picture, sight.holding, sight.kicker_ready, sight.stuck, sensors
        )

    def actuate(self, drive: Drive | None, kick: Kick | None, dribble: bool) -> None:
        """Without effect."""

    def deactivate(self) -> None:
        """Nothing to stop."""

    def close(self) -> None:
        """Nothing to close."""

    def _new_picture(self, taken: float, sight: Sight) -> Picture | None:
        """The picture of a sight in the body frame of its time; None where it was returned before."""
        if taken <= self._picture + 1e-6:
            return None
        self._picture = taken
        then = self._pose_at(taken)
        ball = None
        if sight.ball is not None and sight.ball.visible:
            velocity = to_body(sight.ball.vx, sight.ball.vy, then.heading)
            ball = BodyBall(*_seen(then, sight.ball.x, sight.ball.y), *velocity, sight.ball.z)
        bodies = (Obstacle(*_seen(then, body.x, body.y), body.radius) for body in sight.obstacles)
        return Picture(taken, ball, tuple(bodies))

    def _pose_at(self, time: float) -> Pose:
        """Where the robot was, between two sights; a picture is placed by it again."""
        after = bisect_right(self._times, time)
        if not 0 < after < len(self._times):
            return pose_of(self._sights[min(after, len(self._times) - 1)])
        first, last = self._times[after - 1], self._times[after]
        one, other = pose_of(self._sights[after - 1]), pose_of(self._sights[after])
        return one.toward(other, (time - first) / (last - first))


def _seen(pose: Pose, x: float, y: float) -> tuple[float, float]:
    return to_body(x - pose.x, y - pose.y, pose.heading)
