"""The model of one robot: its body, drive, wheels, dribbler and kicker."""

from dataclasses import dataclass, field

from schemas.config.match_config import MatchConfig
from schemas.config.profile import STANDARD, Profile
from schemas.config.sections import CameraView, Dribble, DriveLimits, Kicker, RobotBody
from schemas.config.wheels import Wheels
from schemas.errors import TouchlineError, did_you_mean
from schemas.side import Side


@dataclass(frozen=True, slots=True)
class RobotModel:
    """One type of robot."""

    type: str
    """Name of the type; `standard` for the profile's own robot."""
    body: RobotBody
    """Body."""
    drive: DriveLimits
    """Limits of the drive."""
    wheels: Wheels
    """Wheels and motors."""
    dribble: Dribble
    """Dribbler."""
    kicker: Kicker
    """Kicker."""
    camera: CameraView = field(default_factory=CameraView)
    """Camera."""

    @classmethod
    def standard(cls, profile: Profile) -> "RobotModel":
        """The standard robot of a profile."""
        return cls.of_type(profile, STANDARD)

    @classmethod
    def of_type(cls, profile: Profile, name: str) -> "RobotModel":
        """A type of robot of a profile."""
        numbers = profile.robot_of_type(name)
        return cls(type=name, body=numbers.pop("robot"), **numbers)


def types_of(profile: Profile) -> dict[str, RobotModel]:
    """Type of robot of a profile → its model, the standard one first."""
    return {name: RobotModel.of_type(profile, name) for name in (STANDARD, *profile.types)}


def models_of(config: MatchConfig, profile: Profile) -> dict[str, RobotModel]:
    """Robot of either side → its model, cyan's first.

    Raises:
        TouchlineError: a robot has a type that is in neither profile nor match file, or a type has an invalid number.
    """
    types = types_of(profile.with_types(config.types, f'match "{config.name}"'))
    models = {}
    for side in Side:
        given = config.team(side).types
        for robot in config.robots(side):
            chosen = given.get(robot, STANDARD)
            if chosen not in types:
                at = f'match "{config.name}": teams.{side.value}.types.{robot}'
                raise TouchlineError(f'{at} is "{chosen}"; {did_you_mean(chosen, types)}')
            models[robot] = types[chosen]
    return models
