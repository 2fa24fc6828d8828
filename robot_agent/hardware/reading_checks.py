"""Refuses readings that cannot be true, and keeps the figures of each device."""

import math
from collections import deque
from dataclasses import replace

from msgspec import structs

from robot_agent.hardware.contract import Picture, SensorReadings
from schemas.config.sections import DriveLimits
from schemas.config.sensors.table import Reading
from schemas.messages.hardware import DeviceHealth
from schemas.messages.radio import Motion

_SLACK = 1.1
"""Share of the top speed up to which a robot is believed to have moved."""
_FASTEST = 3.0
"""Times the top speed, and the top turn rate, that a robot can have: one that is hit is faster for a moment."""
_DRIVES_ON = 0.5
"""s for which a robot is believed to drive without a pose: then it has fallen back."""
_FUTURE = 1e-3
"""s by which a reading may be ahead: clocks are read one after the other."""
OLDEST = 2.0
"""s for which poses are kept; a picture that is older has no place, as by a camera's clock that is another one."""
_RATE_WINDOW = 1.0
"""s over which a rate is counted."""
MOTION, CAMERA, LINE = "motion", "camera", "line"


class _Device:
    """The figures of one source of readings."""

    def __init__(self) -> None:
        self.refused = self.readings = 0
        self._times: deque[float] = deque()
        self._newest: float | None = None

    def take(self, taken: float) -> None:
        """Count a reading that was taken at this time, in s."""
        self.readings += 1
        self._newest = taken
        self._times.append(taken)

    def health(self, now: float) -> DeviceHealth:
        """The figures at a time, in s."""
        while self._times and self._times[0] <= now - _RATE_WINDOW:
            self._times.popleft()
        age = None if self._newest is None else round(max(0.0, now - self._newest), 4)
        rate = len(self._times) / _RATE_WINDOW
        return DeviceHealth(readings=self.readings, refused=self.refused, rate=rate, age=age)


class ReadingChecks:
    """Takes over the readings of one robot, or refuses them."""

    def __init__(self, drive: DriveLimits, jump: float, relocation: float) -> None:
        """`jump` is the most in m by which a pose may differ from what the robot can have reached.

        Poses that agree with each other for `relocation` s are taken over: the robot was carried.
        """
        self._top_speed, self._top_turn_rate = drive.max_speed, drive.max_turn_rate
        self._jump, self._relocation = jump, relocation
        self._devices: dict[str, _Device] = {}
        self._last: tuple[float, Motion] | None = None
        """The newest pose that was taken over, and its time."""
        self._elsewhere: list[tuple[float, Motion]] = []
        """The first and the newest of the poses that jumped and agree with each other."""

    def accept(self, readings: SensorReadings, now: float) -> tuple[SensorReadings, list[str]]:
        """The readings without what is refused, and a sentence for each refusal."""
        faults: list[str] = []
        motion, picture, time = readings.motion, readings.picture, readings.time
        if motion is not None and self._refuses(MOTION, self._motion_fault(time, motion, now), time, faults):
            motion = None
        if picture is not None and self._refuses(CAMERA, _picture_fault(picture, now), picture.time, faults):
            picture = None
        if readings.unreadable:
            self._devices.setdefault(LINE, _Device()).refused += readings.unreadable
            faults.append(f"{LINE}: messages of devices cannot be read, {readings.unreadable} since the last call")
        sensors = {}
        for name, reading in readings.sensors.items():
            taken = time - reading.age
            fault = "a reading is not finite" if not _is_finite(taken, *_numbers(reading)) else _lead(taken, now)
            if not self._refuses(name, fault, taken, faults):
                sensors[name] = reading
        return replace(readings, motion=motion, picture=picture, sensors=sensors), faults

    def health(self, now: float) -> dict[str, DeviceHealth]:
        """Device → its figures at a time in s."""
        return {name: device.health(now) for name, device in self._devices.items()}

    def _refuses(self, name: str, fault: str | None, taken: float, faults: list[str]) -> bool:
        device = self._devices.setdefault(name, _Device())
        if fault is None:
            device.take(taken)
            return False
        device.refused += 1
        faults.append(f"{name}: {fault}")
        return True

    def _motion_fault(self, time: float, motion: Motion, now: float) -> str | None:
        numbers = structs.astuple(motion)
        if not _is_finite(time, *numbers):
            return f"a reading is not finite, {', '.join(f'{number:g}' for number in numbers)} at {time:g} s"
        speed = math.hypot(motion.vx, motion.vy)
        if speed > _FASTEST * self._top_speed or abs(motion.omega) > _FASTEST * self._top_turn_rate:
            return f"a robot does not drive at {speed:.3g} m/s and {motion.omega:.3g} rad/s"
        if ahead := _lead(time, now):
            return ahead
        if self._last is not None and time < self._last[0]:
            return f"a reading is {self._last[0] - time:.3f} s older than the one before"
        excess = 0.0 if self._last is None else self._excess(self._last, time, motion)
        if excess <= self._jump or self._was_carried(time, motion):
            self._last, self._elsewhere = (time, motion), []
            return None
        return f"the pose jumps by {excess:.2f} m more than the robot can have driven"

    def _excess(self, before: tuple[float, Motion], time: float, motion: Motion) -> float:
        """m between two poses beyond what the robot can have driven."""
        then, at = before
        away = math.hypot(motion.x - at.x, motion.y - at.y)
        return away - _SLACK * self._top_speed * max(0.0, min(_DRIVES_ON, time - then))

    def _was_carried(self, time: float, motion: Motion) -> bool:
        """Whether poses far from the last good one have agreed for long enough."""
        if self._elsewhere and self._excess(self._elsewhere[-1], time, motion) <= self._jump:
            self._elsewhere = [self._elsewhere[0], (time, motion)]
        else:
            self._elsewhere = [(time, motion)]
        return time - self._elsewhere[0][0] >= self._relocation


def _picture_fault(picture: Picture, now: float) -> str | None:
    ball = (*picture.ball[:4], picture.ball.z or 0.0) if picture.ball is not None else ()
    bodies = [number for body in picture.obstacles for number in structs.astuple(body)]
    if not _is_finite(picture.time, *ball, *bodies):
        return "a picture has numbers that are not finite"
    if picture.time < now - OLDEST:
        return f"a picture is {now - picture.time:.3g} s old, at most {OLDEST:g}"
    return _lead(picture.time, now, "picture")


def _lead(taken: float, now: float, what: str = "reading") -> str | None:
    """The fault of what was taken later than now."""
    return f"a {what} is {taken - now:.3f} s in the future" if taken > now + _FUTURE else None


def _numbers(reading: Reading) -> list[float]:
    values = structs.astuple(reading)  # type: ignore[arg-type] # every kind is a struct
    within = [number for value in values if isinstance(value, list) for number in value]
    return [number for number in (*values, *within) if isinstance(number, float)]


def _is_finite(*numbers: float) -> bool:
    return all(map(math.isfinite, numbers))
