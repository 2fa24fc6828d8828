"""What one robot of a match is: its body, its drive and wheels, how it holds the ball and how it kicks."""

from dataclasses import dataclass

from schemas.config.match_config import MatchConfig
from schemas.config.profile import STANDARD, Profile
from schemas.config.sections import Dribble, DriveLimits, Kicker, RobotBody, Wheels
from schemas.described import Described
from schemas.errors import TouchlineError, did_you_mean
from schemas.side import Side


@dataclass(frozen=True, slots=True)
class RobotModel(Described):
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

    @classmethod
    def standard(cls, profile: Profile) -> "RobotModel":
        """The robot of a profile, of which most teams are made."""
        return cls.of_type(profile, STANDARD)

    @classmethod
    def of_type(cls, profile: Profile, name: str) -> "RobotModel":
        """A type of robot that the profile knows."""
        numbers = profile.robot_of_type(name)
        return cls(type=name, body=numbers.pop("robot"), **numbers)


def types_of(profile: Profile) -> dict[str, RobotModel]:
    """Every type of robot that a profile knows, the standard one first."""
    return {name: RobotModel.of_type(profile, name) for name in (STANDARD, *profile.types)}


def models_of(config: MatchConfig, profile: Profile) -> dict[str, RobotModel]:
    """Robot → its model, both sides, cyan's first.

    Raises:
        TouchlineError: a robot has a type that neither profile nor match file knows, or a type a wrong number.
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
