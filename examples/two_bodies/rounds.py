"""A brain that drives around a rectangle: the same file in a match and on hardware."""

import math

from touchline import Briefing, Command, Drive, Moment, Score, Sight, skills

CORNERS = ((1.5, 1.0), (-1.5, 1.0), (-1.5, -1.0), (1.5, -1.0))
"""m, in the team frame."""
NEAR = 0.25
"""m from a corner at which the next one is headed for."""


class Rounds:
    """Drives from corner to corner, and looks ahead."""

    def __init__(self, briefing: Briefing) -> None:
        self.limits = skills.DriveLimits.of(briefing.setup)
        self.corner = 0

    def act(self, sight: Sight) -> Command:
        me = sight.self
        x, y = CORNERS[self.corner]
        if math.hypot(x - me.x, y - me.y) < NEAR:
            self.corner = (self.corner + 1) % len(CORNERS)
            x, y = CORNERS[self.corner]
        drive = skills.go_to(me, x, y, math.atan2(y - me.y, x - me.x), self.limits)
        speed = max(1.0, math.hypot(drive.vx, drive.vy) / 1.2)
        return Command(
            answers_tick=sight.tick, drive=Drive(vx=drive.vx / speed, vy=drive.vy / speed, omega=drive.omega)
        )


def driven(now: Moment) -> Score:
    """The metres that the robot has driven, which the game `free` scores in the match."""
    robot = now.robots["cyan1"]
    way = (now.memory or 0.0) + 0.02 * math.hypot(robot.vx, robot.vy)
    return Score(way, memory=way)
