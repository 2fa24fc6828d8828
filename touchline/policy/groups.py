"""The groups of entries of an observation: each names its entries, and reads their numbers from a sight."""

import math
from collections.abc import Callable
from typing import Protocol

from robot_agent.sdk.contract import Briefing
from schemas.config.sensors.compass import Compass, CompassReading
from schemas.config.sensors.contact import Bumper, ContactReading
from schemas.config.sensors.range import RangeFinder, RangeReading
from schemas.config.task import GameName
from schemas.messages.sight import Sight
from touchline.policy.entries import FAST, OLD, BodyFrame, Entry, direction, flag, place, share, signed, velocity
from touchline.policy.interface import Interface

_MINUTE = 60.0
"""s; the time that is 1 in a match without a duration."""


class Group(Protocol):
    """Entries that belong together."""

    @property
    def entries(self) -> tuple[Entry, ...]:
        """Their names and units, in order."""

    def numbers(self, sight: Sight, frame: BodyFrame, /) -> tuple[float, ...] | list[float]:
        """One number for each entry, in its scale and not yet within its limits."""


def has_ball(briefing: Briefing) -> bool:
    """Whether the match has a ball."""
    return briefing.setup.game is GameName.SOCCER


def reach_of(briefing: Briefing) -> float:
    """The largest distance on the floor in m."""
    pitch = briefing.setup.pitch
    return math.hypot(pitch.length + 2 * pitch.border, pitch.width + 2 * pitch.border)


class Place:
    """Where the robot measures itself, in its team frame."""

    def __init__(self, briefing: Briefing) -> None:
        pitch = briefing.setup.pitch
        self._half_x, self._half_y = pitch.goal_line, pitch.touch_line
        limit_x, limit_y = self._half_x + pitch.border, self._half_y + pitch.border
        self.entries = (
            signed("me.x", "m", self._half_x, limit_x, "own place in the team frame, which attacks +x"),
            signed("me.y", "m", self._half_y, limit_y, "own place in the team frame"),
            *direction("me", "own heading in the team frame"),
        )

    def numbers(self, _sight: Sight, frame: BodyFrame) -> tuple[float, ...]:
        """Place and heading."""
        return frame.x / self._half_x, frame.y / self._half_y, frame.cos, frame.sin


class MotionOfBody:
    """How the robot measures its own motion."""

    def __init__(self, briefing: Briefing) -> None:
        drive = briefing.setup.drive
        self._speed, self._turn = drive.max_speed, drive.max_turn_rate
        self.entries = (
            *velocity("me", self._speed, 2 * self._speed, "the robot itself"),
            signed("me.omega", "rad/s", self._turn, 2 * self._turn, "own turn rate, counter-clockwise"),
            flag("me.stuck", "the robot moves much slower than commanded"),
        )

    def numbers(self, sight: Sight, frame: BodyFrame) -> tuple[float, ...]:
        """Velocity, turn rate, stuck."""
        me = sight.self
        vx, vy = frame.vector(me.vx / self._speed, me.vy / self._speed)
        return vx, vy, me.omega / self._turn, float(sight.stuck)


class Ball:
    """The ball as the camera last saw it."""

    def __init__(self, briefing: Briefing) -> None:
        fastest = briefing.setup.kicker.max_ground_speed
        self.entries = (
            flag("ball.seen", "the ball has been seen; otherwise the others are 0"),
            *place("ball", reach_of(briefing), "the ball"),
            *velocity("ball", FAST, max(fastest, FAST), "the ball"),
            share("ball.age", "s", OLD, "time since the camera saw it"),
            flag("ball.held", "the robot holds it"),
            flag("kicker.ready", "the kicker is charged"),
        )

    def numbers(self, sight: Sight, frame: BodyFrame) -> tuple[float, ...]:
        """The ball."""
        ball = sight.ball
        held = (float(sight.holding), float(sight.kicker_ready))
        if ball is None:
            return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, *held
        moving = frame.vector(ball.vx / FAST, ball.vy / FAST)
        return 1.0, *frame.place(ball.x, ball.y), *moving, ball.age / OLD, *held


class Goals:
    """The middles of both goals."""

    def __init__(self, briefing: Briefing) -> None:
        self._line, reach = briefing.setup.pitch.goal_line, reach_of(briefing)
        self.entries = (*place("goal", reach, "the opponents' goal"), *place("own_goal", reach, "the own goal"))

    def numbers(self, _sight: Sight, frame: BodyFrame) -> tuple[float, ...]:
        """Both goals."""
        return *frame.place(self._line, 0.0), *frame.place(-self._line, 0.0)


class Mates:
    """What teammates sent of themselves by radio, in the order of the team's list."""

    def __init__(self, briefing: Briefing) -> None:
        self._mates, self._speed = briefing.teammates, briefing.setup.drive.max_speed
        reach, limit = reach_of(briefing), 2 * self._speed
        entries: list[Entry] = []
        for number, name in enumerate(self._mates, 1):
            key, whose = f"mate{number}", f"teammate {number}, {name}"
            entries += (
                flag(f"{key}.heard", f"{whose}: a message with its place has arrived; otherwise the others are 0"),
                *place(key, reach, whose),
                *velocity(key, self._speed, limit, whose),
                share(f"{key}.age", "s", OLD, f"{whose}: age of its message"),
            )
        self.entries = tuple(entries)

    def numbers(self, sight: Sight, frame: BodyFrame) -> list[float]:
        """All teammates."""
        numbers: list[float] = []
        for name in self._mates:
            heard = sight.radio.get(name)
            if heard is None or heard.self is None:
                numbers += (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
                continue
            mate = heard.self
            moving = frame.vector(mate.vx / self._speed, mate.vy / self._speed)
            numbers += (1.0, *frame.place(mate.x, mate.y), *moving, heard.age / OLD)
        return numbers


class Obstacles:
    """The nearest bodies in the camera's picture, which does not identify them; teammates are among them."""

    def __init__(self, briefing: Briefing) -> None:
        self._most, reach = Interface.of(briefing.parameters).obstacles, reach_of(briefing)
        entries: list[Entry] = []
        for number in range(1, self._most + 1):
            key, whose = f"obstacle{number}", f"obstacle {number} of the nearest"
            entries += (
                flag(f"{key}.seen", f"{whose}: there is one; otherwise the others are 0"),
                *place(key, reach, whose),
                share(f"{key}.radius", "m", 1.0, f"{whose}: radius of the circle around it"),
            )
        self.entries = tuple(entries)

    def numbers(self, sight: Sight, frame: BodyFrame) -> list[float]:
        """The nearest ones."""
        numbers: list[float] = []
        for body in sight.obstacles[: self._most]:
            numbers += (1.0, *frame.place(body.x, body.y), body.radius)
        return numbers + [0.0] * (len(self.entries) - len(numbers))


class Zones:
    """The middles of the task's zones."""

    def __init__(self, briefing: Briefing) -> None:
        self._side, task, reach = briefing.side, briefing.setup.task, reach_of(briefing)
        zones = task.zones if task is not None else []
        self._places = [zone.place for zone in zones]
        self.entries = tuple(
            entry for zone in zones for entry in place(f"zone.{zone.name}", reach, f"zone {zone.name}")
        )

    def numbers(self, sight: Sight, frame: BodyFrame) -> list[float]:
        """All zones; teams change ends with each half, and cyan attacks +x of the field in the first."""
        sign = self._side.attack(1 if sight.game.half % 2 else -1)
        return [number for x, y in self._places for number in frame.place(sign * x, sign * y)]


class Time:
    """The time that is left, and whether the ball may be played."""

    def __init__(self, briefing: Briefing) -> None:
        self._whole = briefing.setup.duration or _MINUTE
        self.entries = (
            share("time.left", "s", self._whole, "time until the task, or the present phase of the game, ends"),
            flag("game.running", "the ball may be played"),
        )

    def numbers(self, sight: Sight, _frame: BodyFrame) -> tuple[float, ...]:
        """Time left, running."""
        left = sight.game.left
        return (left if left is not None else self._whole) / self._whole, float(sight.game.running)


class Scan:
    """The beams of a range finder; one without a return is as far as the sensor reaches."""

    def __init__(self, name: str, sensor: RangeFinder) -> None:
        self._name, self._far, self._beams = name, sensor.max_distance, sensor.beams
        self.entries = tuple(
            share(f"{name}.beam{number}", "m", self._far, f"{name}: distance along beam {number}")
            for number in range(1, sensor.beams + 1)
        )

    def numbers(self, sight: Sight, _frame: BodyFrame) -> list[float]:
        """The newest scan."""
        reading = sight.sensors.get(self._name)
        if not isinstance(reading, RangeReading):
            return [1.0] * self._beams
        return [1.0 if distance is None else distance / self._far for distance in reading.distances]


class Needle:
    """The direction that a compass shows."""

    def __init__(self, name: str, _sensor: Compass) -> None:
        self._name = name
        self.entries = direction(name, f"{name}: heading in the field frame, both 0 before the first reading")

    def numbers(self, sight: Sight, _frame: BodyFrame) -> tuple[float, ...]:
        """The newest heading."""
        reading = sight.sensors.get(self._name)
        if not isinstance(reading, CompassReading):
            return 0.0, 0.0
        return math.cos(reading.heading), math.sin(reading.heading)


class Touch:
    """The sectors of a bumper."""

    def __init__(self, name: str, sensor: Bumper) -> None:
        self._name, self._sectors = name, sensor.sectors
        self.entries = tuple(
            flag(f"{name}.sector{number}", f"{name}: sector {number} touches something")
            for number in range(1, sensor.sectors + 1)
        )

    def numbers(self, sight: Sight, _frame: BodyFrame) -> list[float]:
        """The newest reading."""
        reading = sight.sensors.get(self._name)
        if not isinstance(reading, ContactReading):
            return [0.0] * self._sectors
        return [float(touched) for touched in reading.touched]


OF_SENSOR: dict[str, Callable[..., Group]] = {"range": Scan, "compass": Needle, "contact": Touch}
"""Kind of a sensor → its group."""
OF_MATCH: dict[str, Callable[[Briefing], Group]] = {
    "place": Place,
    "motion": MotionOfBody,
    "ball": Ball,
    "goals": Goals,
    "mates": Mates,
    "obstacles": Obstacles,
    "zones": Zones,
    "time": Time,
}
"""Group → how it is made for a robot; `sensors` are of `OF_SENSOR`."""
WITH_BALL = ("ball", "goals")
"""Groups of matches with a ball."""
