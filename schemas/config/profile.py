"""A profile: its sections and its types of robots, read from TOML.

The package ships the ones in `SHIPPED`. Any other TOML file may extend one with `extends = "msl"` and change numbers.
The `version` of a shipped profile is raised with every change of a number in it, or in one that it extends.
Every number has a unit (declared in `schemas.config.sections`) and an origin (written in the file, kept in
`Profile.origins`).
"""

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from schemas.config.number_files import UNVERSIONED, VERSION_KEY, NumberFiles, read_numbers
from schemas.config.quantity import merge_tables, read_changes
from schemas.config.sections import (
    SECTIONS,
    TYPE_SECTIONS,
    Ball,
    CameraView,
    Dribble,
    DriveLimits,
    Kicker,
    Pitch,
    RadioChannel,
    RobotBody,
    Safety,
    Sensing,
    TimeSteps,
)
from schemas.config.sensors.sections import Sensors, check_mounted, read_sensors
from schemas.config.wheels import Wheels
from schemas.errors import TouchlineError, did_you_mean

SHIPPED = ("msl", "ideal", "omni", "omni3", "differential", "msl-2016", "paper")
"""The profiles that the package ships."""
FILES = NumberFiles("profile", "profiles", SHIPPED)
"""Where profiles are read from."""

SENSORS = "sensors"
"""Table of sensors, below `robot` and below a type."""
STANDARD = "standard"
"""The type of robot whose numbers are in the profile's own sections."""

Changes = Mapping[str, Mapping[str, Any]]
"""Section → key → value: the numbers of a type of robot that differ from the standard type."""


@dataclass(frozen=True, slots=True)
class Profile:
    """All physical numbers of a match."""

    name: str
    """Name of the profile."""
    time: TimeSteps
    """Lengths of the physics step and the control tick."""
    field: Pitch
    """Dimensions of the pitch, its goals and its boundary."""
    robot: RobotBody
    """Body of the standard robot."""
    ball: Ball
    """Body of the ball."""
    drive: DriveLimits
    """Limits of the standard robot's drive."""
    wheels: Wheels
    """Wheels and motors of the standard robot."""
    dribble: Dribble
    """Dribbler of the standard robot."""
    kicker: Kicker
    """Kicker of the standard robot."""
    camera: CameraView
    """Camera of the standard robot."""
    sensing: Sensing
    """What robots perceive, and with which noise."""
    radio: RadioChannel
    """Delay, loss and budget of the radio."""
    safety: Safety
    """When the host stops a silent robot."""
    types: Mapping[str, Changes]
    """Type of robot → its differences from the standard type; `schemas.config.robot_model` makes models of them."""
    origins: Mapping[str, str] = dataclasses.field(repr=False, compare=False)
    """`section.key` → origin of the number."""
    version: int = UNVERSIONED
    """Version of the numbers; 0 for a file without one."""
    sensors: Mapping[str, Sensors] = dataclasses.field(default_factory=dict)
    """Type of robot → its sensors; a type that is not named has the standard robot's."""

    def sensors_of(self, name: str) -> Sensors:
        """The sensors of a type of robot."""
        return self.sensors.get(name, self.sensors.get(STANDARD, {}))

    def robot_of_type(self, name: str) -> dict[str, Any]:
        """Section of `TYPE_SECTIONS` → its numbers for a type of robot."""
        changes = self.types[name] if name != STANDARD else {}
        own = {section: getattr(self, section) for section in TYPE_SECTIONS}
        return own | {section: dataclasses.replace(own[section], **numbers) for section, numbers in changes.items()}

    def with_types(self, tables: Mapping[str, Any], where: str) -> "Profile":
        """The same profile with the types of a match file: new ones, or other numbers for existing ones.

        Raises:
            TouchlineError: a number is invalid or inconsistent with others.
        """
        origins: dict[str, str] = {}
        types = merge_tables(dict(self.types), read_types(tables, where, origins))
        sensors = {**self.sensors, **_sensors_of_types(tables, where, origins, self.sensors_of)}
        profile = dataclasses.replace(self, types=types, origins={**self.origins, **origins}, sensors=sensors)
        check_consistent(profile)
        return profile


def load_profile(name: str) -> Profile:
    """A shipped profile by name, or one from a path that ends in `.toml`.

    Raises:
        TouchlineError: there is no such profile, or it is invalid.
    """
    return shipped_profile(name) if name in SHIPPED else profile_of(name, FILES.tables(name))


@cache
def shipped_profile(name: str) -> Profile:
    """A shipped profile, which is read once: learning begins thousands of matches in a process."""
    return profile_of(name, FILES.tables(name))


def profile_of(name: str, tables: Mapping[str, Any]) -> Profile:
    """The profile of these tables, as `FILES.tables` returns them.

    Raises:
        TouchlineError: they are invalid.
    """
    robot, type_tables = tables.get("robot", {}), tables.get("types", {})
    carried = robot.get(SENSORS, {}) if isinstance(robot, dict) else {}
    if carried:
        tables = {**tables, "robot": {key: value for key, value in robot.items() if key != SENSORS}}
    sections, origins, version = read_numbers(name, tables, SECTIONS, (VERSION_KEY,), ("types",))
    types = read_types(type_tables, name, origins)
    own = read_sensors(carried, name, f"robot.{SENSORS}", origins, {})
    sensors = _sensors_of_types(type_tables, name, origins, lambda _: own)
    sensors = {STANDARD: own, **sensors} if own else sensors
    profile = Profile(name=name, types=types, origins=origins, version=version, sensors=sensors, **sections)
    check_consistent(profile)
    return profile


def read_types(tables: Any, where: str, origins: dict[str, str]) -> dict[str, Changes]:
    """The types of robots in the tables `[types.NAME.<section>]` of a profile or a match file.

    Raises:
        TouchlineError: an unknown section or key, an invalid number, or a type with the name of the standard type.
    """
    types: dict[str, Changes] = {}
    for name, sections in _table(tables, f"{where}: types").items():
        at = f"{where}: types.{name}"
        if name == STANDARD:
            raise TouchlineError(f"{at} is the profile's own robot; change the profile's sections, or rename the type")
        changes = {}
        for section, table in _table(sections, at).items():
            if section == SENSORS:
                continue
            if section not in TYPE_SECTIONS:
                raise TouchlineError(f"{at}.{section} is not known; {did_you_mean(section, (*TYPE_SECTIONS, SENSORS))}")
            changes[section] = read_changes(TYPE_SECTIONS[section], table, where, f"types.{name}.{section}", origins)
        types[name] = changes
    return types


def _sensors_of_types(
    tables: Any, where: str, origins: dict[str, str], before: Callable[[str], Sensors]
) -> dict[str, Sensors]:
    """Type → all of its sensors, for the types in these tables that have some of their own."""
    return {
        name: read_sensors(sections[SENSORS], where, f"types.{name}.{SENSORS}", origins, before(name))
        for name, sections in tables.items()
        if SENSORS in sections
    }


def _table(content: Any, at: str) -> dict[str, Any]:
    if not isinstance(content, dict):
        raise TouchlineError(f"{at} is {content!r}; write tables, for example [types.NAME.drive]")
    return content


def check_consistent(profile: Profile) -> None:
    """Check that the numbers of every type of robot are consistent.

    Raises:
        TouchlineError: two numbers contradict each other.
    """
    for name in (STANDARD, *profile.types):
        where = profile.name if name == STANDARD else f"{profile.name}: types.{name}"
        numbers = profile.robot_of_type(name)
        _check_robot(where, numbers, profile.ball)
        section = f": robot.{SENSORS}" if name == STANDARD else f".{SENSORS}"
        check_mounted(profile.sensors_of(name), numbers["robot"], where + section)


def _check_robot(where: str, numbers: Mapping[str, Any], ball: Ball) -> None:
    robot, dribble = numbers["robot"], numbers["dribble"]
    touching = robot.radius + ball.radius
    if dribble.gap > dribble.distance:
        raise TouchlineError(
            f"{where}: dribble.gap is {dribble.gap} m; a held ball must stay within dribble.distance, "
            f"{dribble.distance} m"
        )
    if dribble.gap < touching - 0.05:
        raise TouchlineError(
            f"{where}: dribble.gap is {dribble.gap} m; robot and ball already touch at {touching:.3f} m"
        )
    if (robot.frame_width > 0) != (robot.frame_depth > 0):
        raise TouchlineError(
            f"{where}: robot.frame_width is {robot.frame_width} m, robot.frame_depth {robot.frame_depth} m; "
            "a frame has both, a robot without a frame has neither"
        )
    _check_wheels(where, numbers["drive"], numbers["wheels"])


def _check_wheels(where: str, drive: DriveLimits, wheels: Wheels) -> None:
    if wheels.max_speed > wheels.no_load_rim_speed:
        raise TouchlineError(
            f"{where}: wheels.max_speed is {wheels.max_speed} m/s; no_load_speed, radius and gear let a rim "
            f"reach {wheels.no_load_rim_speed:.2f} m/s at most"
        )
    if (wheels.count == 2) != (drive.model == "differential"):
        needed = "2 wheels" if drive.model == "differential" else "3 or 4 wheels"
        raise TouchlineError(
            f'{where}: wheels.count is {wheels.count}; a robot whose drive.model is "{drive.model}" has {needed}'
        )
    if drive.model == "differential" and drive.max_speed > wheels.max_speed:
        raise TouchlineError(
            f"{where}: drive.max_speed is {drive.max_speed} m/s; two wheels with wheels.max_speed "
            f"{wheels.max_speed} m/s drive no faster than that"
        )
