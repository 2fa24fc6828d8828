"""What one robot of a match is: its body, its drive and wheels, how it holds the ball and how it kicks."""

from dataclasses import dataclass

from schemas.profile import Dribble, Drive, Kicker, Profile, RobotBody, Wheels


@dataclass(frozen=True, slots=True)
class RobotModel:
    """One type of robot."""

    type: str
    body: RobotBody
    drive: Drive
    wheels: Wheels
    dribble: Dribble
    kicker: Kicker

    @classmethod
    def standard(cls, profile: Profile) -> "RobotModel":
        """The robot of a profile, of which most teams are made."""
        return cls("standard", profile.robot, profile.drive, profile.wheels, profile.dribble, profile.kicker)
