"""The percepts of one robot from the readings of its own sensors: what `sim_host.sensing` makes of the truth.

Everything is kept in the field frame, since sides may change. A picture is placed by the pose that the robot had when
the picture was taken, by its stated time.
"""

import math
from collections import deque

from msgspec.structs import replace

from robot_agent.hardware.contract import Picture, SensorReadings
from robot_agent.hardware.reading_checks import OLDEST
from schemas.config.sensors.table import Reading
from schemas.frames import Pose, rotate, wrap
from schemas.messages.percept import DIGITS, Percept
from schemas.messages.radio import Motion
from schemas.messages.sight import BallSight, Obstacle


class OwnPercepts:
    """What one robot has perceived so far."""

    def __init__(self) -> None:
        self._motions: deque[tuple[float, Motion]] = deque()
        self._picture: Picture | None = None
        self._obstacles: list[tuple[float, float, float]] = []
        """Of the newest picture, the nearest first: x, y, radius in the field frame."""
        self._ball: tuple[float, list[float], float | None] | None = None
        """When the ball was last seen; x, y, vx, vy in the field frame; its height."""
        self._sensors: dict[str, tuple[float, Reading]] = {}
        """Sensor → when its newest reading was taken, and the reading."""
        self.newest = SensorReadings(0.0)
        """The newest readings."""

    @property
    def posed(self) -> float | None:
        """When the newest pose was measured, in s; None before the first."""
        return self._motions[-1][0] if self._motions else None

    def update(self, readings: SensorReadings) -> None:
        """Take over readings that were accepted."""
        self.newest = readings
        if readings.motion is not None:
            self._motions.append((readings.time, readings.motion))
            while self._motions[0][0] < readings.time - OLDEST:
                self._motions.popleft()
        for name, reading in readings.sensors.items():
            self._sensors[name] = readings.time - reading.age, reading
        if readings.picture is not None and self._motions:
            self._take(readings.picture)

    def percept(self, now: float, attack: int) -> Percept:
        """What the robot perceives at a time in s, in the frame of a team that attacks ±x; after the first pose.

        The newest pose is driven on to that time by its velocities.
        """
        motion, pose = self._motions[-1][1], self.pose_at(now).team(attack)
        own = [pose.x, pose.y, wrap(pose.heading), attack * motion.vx, attack * motion.vy, motion.omega]
        picture = self._picture.time if self._picture is not None else 0.0
        obstacles = [
            Obstacle(x=_digits(attack * x), y=_digits(attack * y), radius=_digits(radius))
            for x, y, radius in self._obstacles
        ]
        age = _digits(max(0.0, now - picture))
        numbers = list(map(_digits, own))
        if self._ball is None:
            return Percept(numbers, None, 0.0, False, obstacles, age)
        seen_at, (x, y, vx, vy), height = self._ball
        ball = [_digits(attack * x), _digits(attack * y), _digits(height or 0.0)]
        ball += [_digits(attack * vx), _digits(attack * vy)]
        return Percept(numbers, ball, _digits(max(0.0, now - seen_at)), seen_at == picture, obstacles, age)

    def ball_sight(self, percept: Percept) -> BallSight | None:
        """The ball as a sight has it, without a height that the camera does not measure."""
        sight = percept.ball_sight()
        if sight is None or self._ball is None or self._ball[2] is not None:
            return sight
        return sight.replace(z=None)

    def readings(self, now: float) -> dict[str, Reading]:
        """Sensor → its newest reading with its age at a time in s."""
        aged: dict[str, Reading] = {}
        for name, (taken, reading) in self._sensors.items():
            either: Reading = replace(reading, age=_digits(max(0.0, now - taken)))  # type: ignore[type-var]
            aged[name] = either
        return aged

    def pose_at(self, time: float) -> Pose:
        """The pose in the field frame at a time in s: between two readings, or on from the nearest one."""
        after = next((number for number, (then, _) in enumerate(self._motions) if then >= time), None)
        if after is None or after == 0:
            then, motion = self._motions[-1 if after is None else 0]
            dt = time - then
            x, y, heading = motion.x + motion.vx * dt, motion.y + motion.vy * dt, motion.heading + motion.omega * dt
            return Pose(x, y, wrap(heading))
        (first, one), (last, other) = self._motions[after - 1], self._motions[after]
        share = (time - first) / (last - first)
        return Pose(one.x, one.y, one.heading).toward(Pose(other.x, other.y, other.heading), share)

    def _take(self, picture: Picture) -> None:
        pose = self.pose_at(picture.time)
        self._picture = picture
        near = sorted(picture.obstacles, key=lambda body: math.hypot(body.x, body.y))
        self._obstacles = [(*_placed(pose, body.x, body.y), body.radius) for body in near]
        if picture.ball is not None:
            ball = picture.ball
            place = [*_placed(pose, ball.x, ball.y), *rotate(ball.vx, ball.vy, pose.heading)]
            self._ball = picture.time, place, ball.z


def _placed(pose: Pose, x: float, y: float) -> tuple[float, float]:
    """A place in the body frame of a robot at a pose, in the frame of the pose."""
    dx, dy = rotate(x, y, pose.heading)
    return pose.x + dx, pose.y + dy


def _digits(number: float) -> float:
    return round(number, DIGITS) + 0.0
