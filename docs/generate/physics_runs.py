"""Runs of the host's world for docs/physics.md: each function simulates one and returns its numbers.

No number is computed from a formula: bodies are placed, receive inputs, and are read tick by tick.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from schemas.config.profile import Profile, load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.roster import Placement
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive, Kick, KickMode
from schemas.side import Side
from sim_host.match.world import World
from sim_host.sensing.perception import Perception
from sim_host.sensing.random_streams import RandomStreams
from sim_host.snapshot import Roster, Snapshot
from sim_host.soccer.game import ARENA

Floats = NDArray[np.float64]
Told = Callable[[float], Mapping[str, AppliedInput]]
"""Time in s → inputs of robots; a robot without an input rests."""
Pose = tuple[float, float, float]
"""x, y in m, heading in rad."""
NAMES = ("cyan1", "magenta1")
DRIVES = {"traction": "msl", "omni, four wheels": "omni", "omni, three wheels": "omni3"}
"""Label of a drive in a plot → the profile with that drive."""
METHODS = ("pose", "velocity", "force")


class Run(NamedTuple):
    """One run: times, s, and the snapshot at each."""

    times: Floats
    snapshots: list[Snapshot]

    def robot(self, name: str, *fields: str) -> Floats:
        """Fields of a robot's states, one row a tick."""
        place = NAMES.index(name)
        return np.array([[getattr(one.robots[place], field) for field in fields] for one in self.snapshots])

    def ball(self, *fields: str) -> Floats:
        """Fields of the ball's states, one row a tick."""
        return np.array([[getattr(one.ball, field) for field in fields] for one in self.snapshots])


def told(
    vx: float = 0.0, vy: float = 0.0, omega: float = 0.0, dribble: bool = False, kick: Kick | None = None
) -> AppliedInput:
    """An input, in the body frame: m/s, rad/s."""
    return AppliedInput(Drive(vx=vx, vy=vy, omega=omega), dribble, kick)


def always(inputs: Mapping[str, AppliedInput]) -> Told:
    """The same inputs at all times."""
    return lambda _: inputs


def at_first(inputs: Mapping[str, AppliedInput]) -> Told:
    """Inputs at the beginning, then rest."""
    return lambda time: inputs if time == 0.0 else {}


def play(
    profile: Profile,
    bodies: Mapping[str, Pose],
    tell: Told,
    seconds: float,
    models: Sequence[RobotModel] | None = None,
    launch: tuple[float, float, float] | None = None,
    height: float = 0.0,
) -> Run:
    """Simulate two robots and the ball from given poses; robots without a pose stand in two corners.

    `launch` sets the ball going at m/s, without spin; `height` lifts it, m.
    """
    models = tuple(models or (RobotModel.standard(profile),) * len(NAMES))
    world = World(profile, Roster(NAMES, tuple(Side), {Side.CYAN: NAMES[0], Side.MAGENTA: NAMES[1]}, models), ARENA)
    x, y = profile.field.goal_line - 1.0, profile.field.touch_line - 1.0
    aside = {"cyan1": (-x, y, 0.0), "magenta1": (-x, -y, 0.0)}
    poses = aside | dict(bodies)
    placements = [Placement(body=name, x=x, y=y, heading=heading) for name, (x, y, heading) in poses.items()]
    if launch is not None:
        (vx, vy, vz), z = launch, profile.ball.radius + height
        placements = [at.replace(vx=vx, vy=vy, vz=vz, z=z) if at.body == "ball" else at for at in placements]
    world.place(placements)
    rest = dict.fromkeys(NAMES, told())
    snapshots = [world.snapshot()]
    while snapshots[-1].time < seconds:
        snapshots.append(world.advance({**rest, **tell(snapshots[-1].time)}).snapshot)
    world.close()
    return Run(np.array([one.time for one in snapshots]), snapshots)


def nothing(_time: float) -> Mapping[str, AppliedInput]:
    """All robots rest."""
    return {}


def step_response(profile_name: str, speed: float = 3.0) -> Run:
    """From rest to `speed` m/s along the kick axis, and back to rest after 2 s."""
    return play(
        load_profile(profile_name),
        {"cyan1": (-6.0, 0.0, 0.0)},
        lambda time: {"cyan1": told(speed if time < 2.0 else 0.0)},
        3.5,
    )


def top_speeds(profile_name: str, directions: int) -> tuple[Floats, Floats]:
    """Directions in the body frame, rad, and the top speed in each of a robot that its wheels alone limit, m/s."""
    profile = load_profile(profile_name)
    profile = replace(profile, drive=replace(profile.drive, max_speed=20.0))
    angles, speeds = np.linspace(0.0, 2.0 * math.pi, directions + 1), []
    for angle in angles:
        demand = {"cyan1": told(20.0 * math.cos(angle), 20.0 * math.sin(angle))}
        run = play(profile, {"cyan1": (-8.0, 0.0, -angle)}, always(demand), 3.4)
        speeds.append(math.hypot(*run.robot("cyan1", "vx", "vy")[-1]))
    return angles, np.array(speeds)


def ball_roll(kick_spin: float, speed: float = 4.0) -> Run:
    """A ball that is kicked at `speed` m/s along x, with a share of the spin of rolling."""
    profile = load_profile("msl")
    profile = replace(profile, kicker=replace(profile.kicker, kick_spin=kick_spin))
    kick = Kick(mode=KickMode.GROUND, speed=speed)
    bodies = {"cyan1": (-8.0, 0.0, 0.0), "ball": (-8.0 + profile.dribble.gap, 0.0, 0.0)}
    return play(profile, bodies, at_first({"cyan1": told(kick=kick)}), 8.0)


def bounce(height: float = 1.0) -> Run:
    """A ball that is dropped with `height` m of air below it."""
    return play(load_profile("msl"), {"ball": (0.0, 0.0, 0.0)}, nothing, 2.5, launch=(0.0, 0.0, 0.0), height=height)


def kick(mode: KickMode, speed: float, distance: float, profile: Profile, seconds: float = 2.5) -> Run:
    """A kick along x from a robot whose ball lies `distance` m before the goal plane."""
    x, gap = profile.field.goal_line - distance, profile.dribble.gap
    told_once = told(kick=Kick(mode=mode, speed=speed))
    bodies = {"cyan1": (x - gap, 0.0, 0.0), "ball": (x, 0.0, 0.0)}
    return play(profile, bodies, at_first({"cyan1": told_once}), seconds)


def without_air(profile: Profile) -> Profile:
    """The same profile in a vacuum."""
    return replace(profile, ball=replace(profile.ball, air_density=0.0))


def duel(change: Mapping[str, Mapping[str, float]], seconds: float = 3.0) -> Run:
    """Two robots on wheels push head-on at a demand of 2 m/s; `change` scales magenta's: section → number → factor."""
    profile = load_profile("omni")
    standard = other = RobotModel.standard(profile)
    for section, factors in change.items():
        numbers = getattr(other, section)
        scaled = {name: getattr(numbers, name) * factor for name, factor in factors.items()}
        other = replace(other, **{section: replace(numbers, **scaled)})
    apart = profile.robot.radius + 0.05
    bodies = {"cyan1": (-apart, 0.0, 0.0), "magenta1": (apart, 0.0, math.pi), "ball": (0.0, 5.0, 0.0)}
    push = {"cyan1": told(2.0), "magenta1": told(2.0)}
    return play(profile, bodies, always(push), seconds, models=(standard, other))


def dribble(method: str, speed: float = 2.0, turn_gain: float = 1.5, seconds: float = 4.0) -> Run:
    """A robot at `speed` m/s holds the ball and turns ever faster: after 1 s, by `turn_gain` rad/s each second."""
    profile = load_profile("msl")
    profile = replace(profile, dribble=replace(profile.dribble, method=method))

    def tell(time: float) -> Mapping[str, AppliedInput]:
        return {"cyan1": told(speed, omega=turn_gain * max(0.0, time - 1.0), dribble=True)}

    bodies = {"cyan1": (-4.0, -2.0, 0.0), "ball": (-4.0 + profile.dribble.gap, -2.0, 0.0)}
    return play(profile, bodies, tell, seconds)


def errors(distance: float, pictures: int) -> Floats:
    """Errors of a ball seen `distance` m away, along the line of sight and across it, (pictures, 2), m."""
    profile = load_profile("msl")
    still = replace(profile.sensing, drift_position=0.0, drift_heading=0.0, ball_dropout=0.0, latency=0.0)
    roster = Roster(NAMES[:1], (Side.CYAN,), {Side.CYAN: NAMES[0]}, (RobotModel.standard(profile),))
    world = World(profile, roster, ARENA)
    world.place([Placement(body="cyan1", x=0.0, y=0.0), Placement(body="ball", x=distance, y=0.0)])
    snapshot, perception = world.snapshot(), Perception(still, roster, RandomStreams(7), profile.time.tick)
    seen = []
    for tick in range(10**9):
        (percept,) = perception.at(replace(snapshot, tick=tick), 1)
        if percept.ball_age == 0.0 and percept.visible and percept.ball is not None:
            seen.append((percept.ball[0] - distance, percept.ball[1]))
        if len(seen) == pictures:
            break
    world.close()
    return np.array(seen)
