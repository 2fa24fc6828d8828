"""A short match in one process in which everything the checked team does is measured."""

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from robot_agent.hardware.clearance import keep_clear
from robot_agent.process.timing import HANG_S
from runtime.process.clock import Clock
from schemas.config.shipped_teams import SHIPPED_TEAMS
from schemas.messages.command import Command, KickMode
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.wire.part import encode
from sim_host.match.simulation import TickResult
from touchline.play.play_match import play_match
from touchline.team.check.subject import CheckedRobot, Subject

OPPONENT = SHIPPED_TEAMS["simple"]
_MARGIN = 1.001
"""A demand above a limit by less than this factor is a rounding."""


@dataclass(slots=True)
class Decision:
    """One decision of the checked team."""

    tick: int
    robot: str
    seconds: float
    """Wall time of `act`."""
    payload: bytes
    """The command, encoded."""


@dataclass(slots=True)
class Played:
    """What the checked team did in a match."""

    decisions: list[Decision] = field(default_factory=list)
    excesses: list[str] = field(default_factory=list)
    """A sentence for each demand beyond a limit of its robot."""
    refusals: list[str] = field(default_factory=list)
    """A sentence for each part of a command that the host has refused."""
    sights: dict[str, Sight] = field(default_factory=dict)
    """Robot → its last sight."""
    excess_s: float = 0.0
    """By how much all decisions after the first tick took longer than a tick each."""
    is_slow: bool = False
    """The decisions took much longer than their ticks, and the match was ended early."""


def play_checked(
    subject: Subject,
    seconds: float,
    clock: Clock,
    watch: Callable[[TickResult], None] | None = None,
    clearance: float | None = None,
) -> Played:
    """Play a match of `seconds` of simulated time against the team `simple`; it ends early if a robot is too slow.

    `watch` sees each tick; `clearance` is that of the filter of hardware in m, None without it.

    Raises:
        BreachError: the checked team breaks the contract.
    """
    config, setup, played = subject.config, subject.setup(), Played()
    changes = {"brain": OPPONENT, "command": None, "stdio": None, "remote": False}
    teams = config.teams.model_copy(update={"magenta": config.teams.magenta.model_copy(update=changes)})
    robots: dict[str, CheckedRobot] = {}
    try:
        for robot in subject.robots:
            robots[robot] = subject.start(robot, setup)
        brains: dict[str, Any] = {
            name: _Measured(one, setup, played, clock.now, clearance) for name, one in robots.items()
        }
        with suppress(EndedEarlyError):
            config = config.model_copy(update={"teams": teams})
            play_match(config, brains, watch, until=seconds, brain_folder=subject.folder)
    finally:
        for one in robots.values():
            one.close()
    return played


class EndedEarlyError(Exception):
    """A match that shows nothing else: decisions take so much longer than their ticks that it would take minutes."""


class _Measured:
    """A brain around another robot's."""

    def __init__(
        self, robot: CheckedRobot, setup: Setup, played: Played, now: Callable[[], float], clearance: float | None
    ) -> None:
        self._clearance = clearance
        self._robot, self._played, self._now = robot, played, now
        self._limits = setup.for_robot(robot.robot)

    def act(self, sight: Sight) -> Command:
        """The command of the robot's own brain."""
        began = self._now()
        command = self._robot.act(sight)
        took = self._now() - began
        played, name = self._played, self._robot.robot
        played.decisions.append(Decision(sight.tick, name, took, encode(command)))
        played.refusals += [f"{name} at tick {sight.tick}: {reason}" for reason in sight.outcome.refused]
        played.excesses += [f"{name} at tick {sight.tick}: {excess}" for excess in excesses(command, self._limits)]
        played.sights[name] = sight
        if sight.tick > 0:
            played.excess_s += took - self._limits.time.tick
        if played.excess_s > HANG_S:
            played.is_slow = True
            raise EndedEarlyError
        if self._clearance is None:
            return command
        return command.replace(drive=keep_clear(command.drive, sight, self._limits, self._clearance))


def excesses(command: Command, setup: Setup) -> list[str]:
    """A sentence for each demand of a command beyond a limit of the robot whose setup this is."""
    drive, kick, limits, kicker = command.drive, command.kick, setup.drive, setup.kicker
    most_kick = 0.0
    if kick is not None:
        most = {KickMode.LOB: kicker.max_lob_speed, KickMode.LOFT: kicker.max_air_speed}
        most_kick = most.get(kick.mode, kicker.max_ground_speed)
    demands = (
        ("drive", math.hypot(drive.vx, drive.vy), limits.max_speed, "m/s"),
        ("drive.omega", abs(drive.omega), limits.max_turn_rate, "rad/s"),
        ("kick.speed", kick.speed if kick is not None else 0.0, most_kick, "m/s"),
    )
    return [
        f"{name} is {demand:.2f} {unit}, the limit is {most:g}"
        for name, demand, most, unit in demands
        if demand > most * _MARGIN
    ]
