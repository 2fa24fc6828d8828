"""What happened in a scene that was played: occurrences, positions, kicks, commands, verdict."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from recordings.soccer.stats.kicks import PASSES, SHOTS, KickRecord
from robot_agent.sdk.skills.keep_out import Area
from schemas.config.sections import Pitch
from schemas.config.soccer.drill import OCCURRENCES
from schemas.errors import did_you_mean
from schemas.messages.command import Command
from schemas.messages.soccer.game import GameEvent
from schemas.side import Side
from schemas.soccer.game import Score
from touchline.matches.judging.judge import DrillVerdict
from touchline.matches.judging.occurrences import Occurrence

Rectangle = tuple[float, float, float, float]
"""Least x and y, greatest x and y, in m, in the field frame."""
AREAS: dict[str, Callable[[Pitch, int, float, float], bool]] = {
    "goal_area": lambda pitch, end, x, y: _is_before_goal(Area.goal(pitch), pitch, end, x, y),
    "penalty_area": lambda pitch, end, x, y: _is_before_goal(Area.penalty(pitch), pitch, end, x, y),
    "half": lambda _, end, x, __: x * end > 0,
}
"""Areas of a side; `goal_area:cyan` is the one before cyan's own goal."""
_DETAILS = 8
"""Most occurrences that a summary names."""


@dataclass(frozen=True, slots=True)
class Facts:
    """What happened from the start of a scene on; in m, rad and s, in the field frame, where cyan attacks +x."""

    scene: str
    seed: int
    verdict: DrillVerdict | None
    """The scene's verdict; None without a `[drill]`, or if it was not decided in the time played."""
    score: Score
    pitch: Pitch
    events: Sequence[GameEvent]
    """The events of the referee."""
    occurrences: Sequence[Occurrence]
    """All that happened, by the names that scenes use, in order of time."""
    kicks: Sequence[KickRecord]
    """All kicks with their outcomes, as `touchline stats` has them."""
    times: NDArray[np.float64]
    """Time of each tick."""
    ball: NDArray[np.float64]
    """x, y and z of the ball at each tick."""
    robots: dict[str, NDArray[np.float64]]
    """Robot → x, y and heading at each tick; NaN while it is off the field."""
    commands: Mapping[str, Sequence[Command]]
    """Robot → its command of each tick, in the team frame."""

    @property
    def seconds(self) -> float:
        """How long was played."""
        return float(self.times[-1])

    @property
    def success(self) -> bool:
        """Whether the scene's verdict is a success."""
        return self.verdict is not None and self.verdict.success

    @property
    def shots(self) -> list[KickRecord]:
        """The kicks that were shots."""
        return [kick for kick in self.kicks if kick.outcome in SHOTS]

    @property
    def passes(self) -> list[KickRecord]:
        """The kicks that were passes, received or lost."""
        return [kick for kick in self.kicks if kick.outcome in PASSES]

    def all(self, what: str) -> list[Occurrence]:
        """All occurrences of `shot`, `goal:cyan` or `touch:cyan2`, in order of time.

        Raises:
            ValueError: nothing has that name, or no robot or side.
        """
        name, colon, who = what.partition(":")
        if name not in OCCURRENCES:
            raise ValueError(f'"{what}": {did_you_mean(name, OCCURRENCES)}')
        if colon and who not in (*Side, *self.robots):
            raise ValueError(f'"{what}": known: {", ".join((*Side, *self.robots))}')
        return [one for one in self.occurrences if one.is_meant_by(what)]

    def has(self, what: str) -> bool:
        """Whether it happened."""
        return bool(self.all(what))

    def count(self, what: str) -> int:
        """How often it happened."""
        return len(self.all(what))

    def first(self, what: str) -> Occurrence:
        """The first occurrence.

        Raises:
            AssertionError: it did not happen.
        """
        __tracebackhide__ = True
        found = self.all(what)
        if not found:
            raise AssertionError(f"no {what} in {self.seconds:.1f} s of {self}")
        return found[0]

    def enters(self, robot: str, area: str | Rectangle) -> bool:
        """Whether the centre of a robot was ever in an area: `goal_area:cyan`, `penalty_area:magenta`, `half:cyan`,
        or a rectangle.

        Raises:
            ValueError: there is no such robot or area.
        """
        return any(self._inside(robot, area))

    def time_in(self, robot: str, area: str | Rectangle) -> float:
        """How long the centre of a robot was in an area, see `enters`."""
        tick = float(self.times[1] - self.times[0]) if len(self.times) > 1 else 0.0
        return sum(self._inside(robot, area)) * tick

    def distance(self, robot: str) -> float:
        """Length of the path of a robot, in m."""
        steps = np.diff(self._way(robot)[:, :2], axis=0)
        return float(np.nansum(np.hypot(steps[:, 0], steps[:, 1])))

    def closest(self, one: str, other: str) -> float:
        """Least distance between the centres of two robots, or of a robot and `ball`, on the ground."""
        apart = self._way(one)[:, :2] - self._way(other)[:, :2]
        return float(np.nanmin(np.hypot(apart[:, 0], apart[:, 1])))

    def debug(self, robot: str, name: str) -> list[tuple[float, float | int | bool | str]]:
        """Time and value of a debug value in all commands of a robot that have it."""
        self._way(robot)
        commands = zip(self.times, self.commands.get(robot, ()), strict=False)
        found = ((time, one.debug.values) for time, one in commands if one.debug is not None)
        return [(float(time), values[name]) for time, values in found if name in values]

    def _way(self, body: str) -> NDArray[np.float64]:
        if body == "ball":
            return self.ball
        if body not in self.robots:
            raise ValueError(f'robot is "{body}"; {did_you_mean(body, self.robots)}')
        return self.robots[body]

    def _inside(self, robot: str, area: str | Rectangle) -> list[bool]:
        way = [(float(x), float(y)) for x, y, _ in self._way(robot)]
        if not isinstance(area, str):
            least_x, least_y, most_x, most_y = area
            return [least_x <= x <= most_x and least_y <= y <= most_y for x, y in way]
        name, _, side = area.partition(":")
        if name not in AREAS or side not in tuple(Side):
            known = [f"{one}:{of}" for one in AREAS for of in Side]
            raise ValueError(f'area is "{area}"; {did_you_mean(area, known)}')
        end = -Side(side).attack(1)
        return [not math.isnan(x) and AREAS[name](self.pitch, end, x, y) for x, y in way]

    def __str__(self) -> str:
        told = [str(one) for one in self.occurrences if one.name != "touch"]
        more = f", and {len(told) - _DETAILS} more" if len(told) > _DETAILS else ""
        return f"{self.scene}, seed {self.seed}: {', '.join(told[:_DETAILS]) or 'nothing happened'}{more}"

    __repr__ = __str__


def _is_before_goal(area: Area, pitch: Pitch, end: int, x: float, y: float) -> bool:
    """Whether a place is in the area at that end, or in the goal behind it; not behind the line next to the goal."""
    return area.has(end, x, y) and (x * end <= pitch.goal_line or abs(y) < pitch.goal_width / 2)
