"""A world of robots and a ball that tests place, push and look at."""

import math
from dataclasses import replace

from schemas.config.match_config import load_match
from schemas.config.robot_model import RobotModel
from schemas.config.roster import Placement
from schemas.messages.command import Drive, Kick, KickMode
from schemas.messages.host import AppliedInput
from sim_host.match.world import World
from sim_host.snapshot import Roster

NAMES = ("cyan1", "cyan2", "magenta1", "magenta2")


class WorldRig:
    """Four robots parked in the corners, the ball in the middle; `order` shuffles the roster."""

    def __init__(self, profile, order=NAMES):
        config = load_match(None, {"teams.cyan.size": 2, "teams.magenta.size": 2})
        roster = Roster.of(config, profile)
        sides = dict(zip(roster.names, roster.sides, strict=True))
        models = (RobotModel.standard(profile),) * len(order)
        self.profile = profile
        self.roster = replace(roster, names=tuple(order), sides=tuple(sides[name] for name in order), models=models)
        self.world = World(profile, self.roster)
        x, y = profile.field.goal_line - 1, profile.field.touch_line - 1
        self.place(cyan1=(-x, y, 0), cyan2=(-x, -y, 0), magenta1=(x, y, 0), magenta2=(x, -y, 0), ball=(0, 0, 0))
        self.refused = {}

    def place(self, **bodies):
        self.world.place([Placement(body=body, x=x, y=y, heading=turn) for body, (x, y, turn) in bodies.items()])

    def give(self, robot, x, y=0.0, heading=0.0):
        """Set a robot down with the ball at its gap."""
        gap = self.profile.dribble.gap
        ball = (x + gap * math.cos(heading), y + gap * math.sin(heading), 0)
        self.place(**{robot: (x, y, heading), "ball": ball})

    def tick(self, **told):
        advance = self.world.advance({name: told.get(name, tell()) for name in self.roster.names})
        self.refused = advance.refused
        return advance.snapshot

    def run(self, seconds, **told):
        for _ in range(round(seconds / self.profile.time.tick)):
            snapshot = self.tick(**told)
        return snapshot

    def set_ball(self, position, velocity=(0, 0, 0), spin=(0, 0, 0)):
        """Set the ball going by hand, as no robot can."""
        self.world._engine.set_ball_state(position, velocity, spin)
        self.world._engine.read()
        self.world._read_states()

    def ball_motion(self):
        """Position, orientation, velocity and spin."""
        return self.world._engine.ball_now()

    def at(self, snapshot, robot):
        return snapshot.robots[self.roster.names.index(robot)]


def tell(vx=0.0, vy=0.0, omega=0.0, dribble=False, kick=None):
    """An input; a kick as (mode, speed)."""
    wish = Kick(mode=KickMode(kick[0]), speed=kick[1]) if kick else None
    return AppliedInput(Drive(vx=vx, vy=vy, omega=omega), dribble=dribble, kick=wish)
