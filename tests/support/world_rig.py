"""A world of robots and a ball that tests place, push and measure."""

import math

import pybullet

from schemas.config.match_config import load_match
from schemas.config.profile import Profile
from schemas.config.roster import Placement
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive, Kick, KickMode
from sim_host.match.world import World, WorldTick
from sim_host.physics.engine import Engine
from sim_host.physics.vectors import Vector
from sim_host.snapshot import RobotState, Roster, Snapshot
from sim_host.soccer.game import ARENA

REST = AppliedInput(Drive(), dribble=False)


def tell(
    vx: float = 0.0, vy: float = 0.0, omega: float = 0.0, dribble: bool = False, kick: tuple[str, float] | None = None
) -> AppliedInput:
    """An input; a kick as (mode, speed)."""
    wish = Kick(mode=KickMode(kick[0]), speed=kick[1]) if kick else None
    return AppliedInput(Drive(vx=vx, vy=vy, omega=omega), dribble=dribble, kick=wish)


class WorldRig:
    """Robots parked at the edge of the pitch, the ball in the middle; robots without an input rest."""

    def __init__(self, profile: Profile, roster: Roster | None = None) -> None:
        """`roster`: the robots; two standard robots a side if not given."""
        self.profile = profile
        self.roster = roster or two_a_side(profile)
        self.engine = Engine(profile, self.roster)
        self.world = World(profile, self.roster, ARENA, self.engine)
        self.refused: dict[str, str] = {}
        """Robot → why its kick was refused in the last tick."""
        self.stuck: list[bool] = []
        """Whether each robot was stuck in the last tick, in roster order."""
        x, y = profile.field.goal_line - 1, profile.field.touch_line - 1
        corners = [(-x, y), (-x, -y), (x, y), (x, -y)]
        if len(self.roster.names) > len(corners):
            corners = [(0.7 * place - x, y + 1) for place in range(len(self.roster.names))]
        parked = {name: (*corner, 0.0) for name, corner in zip(self.roster.names, corners, strict=False)}
        self.place(**parked, ball=(0, 0, 0))

    def place(self, **bodies: tuple[float, float, float]) -> None:
        """Set bodies down at x, y and heading."""
        self.world.place([Placement(body=body, x=x, y=y, heading=turn) for body, (x, y, turn) in bodies.items()])

    def give(self, robot: str, x: float, y: float = 0.0, heading: float = 0.0) -> None:
        """Set a robot down with the ball at its gap."""
        gap = self.profile.dribble.gap
        ball = (x + gap * math.cos(heading), y + gap * math.sin(heading), 0.0)
        self.place(**{robot: (x, y, heading), "ball": ball})

    def set_ball(self, position: Vector, velocity: Vector = (0, 0, 0), spin: Vector = (0, 0, 0)) -> None:
        """Set the ball going by hand, as no robot can."""
        (x, y, z), (vx, vy, vz) = position, velocity
        self.world.place([Placement(body="ball", x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)])
        self.engine.set_ball_motion(velocity, spin)
        self.engine.read()

    def tick(self, **inputs: AppliedInput) -> Snapshot:
        advance: WorldTick = self.world.advance({name: inputs.get(name, REST) for name in self.roster.names})
        self.refused, self.stuck = advance.refused, advance.stuck
        return advance.snapshot

    def run(self, seconds: float, **inputs: AppliedInput) -> Snapshot:
        for _ in range(round(seconds / self.profile.time.tick)):
            snapshot = self.tick(**inputs)
        return snapshot

    def at(self, name: str) -> RobotState:
        """The state of a robot."""
        robots = self.world.snapshot().robots
        state: RobotState = robots[self.roster.names.index(name)]
        return state

    def copy_to(self, other: "WorldRig") -> None:
        """Make a checkpoint of this world in another one with a different past."""
        now = self.world.snapshot()
        self.world.make_checkpoint()
        other.world.begin_at(now.tick, now.robots, now.ball, b"")
        other.world.make_checkpoint()

    def depth(self) -> float:
        """How deep the deepest robot is in a robot, wall or obstacle, m, as the engine's own shapes lie."""
        found = 0.0
        for body in self.engine.robots:
            for other in (*self.engine.robots, *self.engine.fixed_bodies()):
                if other == body:
                    continue
                for point in pybullet.getClosestPoints(body, other, 0.0, physicsClientId=self.engine.client):
                    found = max(found, -point[8])
        return found


def two_a_side(profile: Profile) -> Roster:
    """Standard robots of a profile, two on each side."""
    return Roster.of(load_match(None, {"teams.cyan.size": 2, "teams.magenta.size": 2}), profile)
