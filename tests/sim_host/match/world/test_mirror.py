"""The mirror: a turned or reflected scene with the commands turned or reflected is the turned or reflected world.

Turning by π swaps the sides: what cyan does in one world, magenta does in the other. Reflecting swaps left and right.
The robots change places in the roster too, so no order is an advantage.

Tolerances: nothing but rounding (1e-9) may come between two worlds until bodies touch. A contact multiplies what
rounding has left, and the engine looks for contact points and orders its equations by the bodies' numbers; a
reflection besides turns its friction axes the other way round. So after contacts two worlds may be millimetres apart
when one is turned, more when it is reflected; a ball that rebounds from a round hull besides has a way of some metres
on which 3 mrad become a centimetre.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import pytest
from msgspec import structs
from pytest import approx

from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.roster import Placement
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive, Kick, KickMode
from schemas.side import Side
from sim_host.match.world import World
from sim_host.snapshot import Roster, Snapshot
from sim_host.soccer.game import ARENA

PROFILE = load_profile("msl")
NAMES = ("cyan1", "cyan2", "cyan3", "magenta1", "magenta2", "magenta3")
SIDES = (Side.CYAN,) * 3 + (Side.MAGENTA,) * 3
Poses = dict[str, tuple[float, float, float]]
Told = Callable[[int], dict[str, AppliedInput]]


class Mirror(NamedTuple):
    """What becomes of x, y and of turns to the left; and of names."""

    x: int
    y: int
    left: int
    turn: float
    swaps_sides: bool

    def name(self, name: str) -> str:
        if not self.swaps_sides or name == "ball":
            return name
        colour, number = name[:-1], name[-1]
        return {"cyan": "magenta", "magenta": "cyan"}[colour] + number

    def told(self, told: AppliedInput) -> AppliedInput:
        drive = told.drive
        return structs.replace(told, drive=Drive(vx=drive.vx, vy=self.left * drive.vy, omega=self.left * drive.omega))


TURNED = Mirror(-1, -1, 1, math.pi, swaps_sides=True)
REFLECTED = Mirror(1, -1, -1, 0.0, swaps_sides=False)


class Scene(NamedTuple):
    """Start poses of the bodies, and the inputs of the robots, tick by tick."""

    poses: Poses
    told: Told
    ticks: int
    turned: float
    """m; how far apart the worlds may be in the end when one is turned."""
    reflected: float
    """m; likewise when one is reflected."""


def go(vx: float = 0.0, vy: float = 0.0, omega: float = 0.0, **more: object) -> AppliedInput:
    return AppliedInput(Drive(vx=vx, vy=vy, omega=omega), **{"dribble": False, **more})  # type: ignore[arg-type]


def driving(tick: int) -> dict[str, AppliedInput]:
    """All robots drive and turn, and none meet."""
    return {name: go(1 + 0.3 * place, 0.5 - 0.2 * place, (-1) ** place * 1.5) for place, name in enumerate(NAMES)}


def dribbling(tick: int) -> dict[str, AppliedInput]:
    """One carries the ball in an arc."""
    return {"cyan1": go(1.5, 0.3, 0.8, dribble=True)}


def kicking(mode: KickMode) -> Told:
    def told(tick: int) -> dict[str, AppliedInput]:
        if tick == 20:
            return {"cyan1": go(kick=Kick(mode=mode, speed=7.0))}
        return {"cyan1": go(0.5, 0.0, 0.2, dribble=tick < 20)}

    return told


def pushing(tick: int) -> dict[str, AppliedInput]:
    """Two robots run into each other, off the middle."""
    return {"cyan2": go(1.5), "magenta2": go(1.2, 0.0, 0.1)}


def rebounding(tick: int) -> dict[str, AppliedInput]:
    """A ground kick against the side of a robot that stands."""
    return {"cyan1": go(kick=Kick(mode=KickMode.GROUND, speed=5.0))} if tick == 5 else {"cyan1": go(dribble=True)}


def scrambling(tick: int) -> dict[str, AppliedInput]:
    """Three robots run at one ball from three sides, and one of them takes it."""
    return {"cyan2": go(1.2), "cyan3": go(1.5, omega=0.2), "magenta2": go(1.0, 0.1, dribble=True)}


GAP = PROFILE.dribble.gap
APART: Poses = {
    "cyan1": (-6.0, 0.5, 0.2),
    "cyan2": (-3.0, 3.0, 0.1),
    "cyan3": (-3.0, -4.0, 1.0),
    "magenta1": (6.0, 1.0, 3.0),
    "magenta2": (0.5, 3.1, 3.1),
    "magenta3": (4.0, -3.0, 2.0),
}
WITH_BALL: Poses = APART | {"ball": (-6.0 + GAP * math.cos(0.2), 0.5 + GAP * math.sin(0.2), 0.0)}
SCRUM: Poses = APART | {
    "cyan2": (-1.2, 0.1, 0.0),
    "cyan3": (0.2, -1.3, 1.6),
    "magenta2": (1.4, 0.0, 3.1),
    "ball": (0.1, 0.02, 0.0),
}
SCENES = {
    "driving": Scene(APART | {"ball": (0.0, -6.0, 0.0)}, driving, 100, 1e-9, 1e-9),
    "dribbling": Scene(WITH_BALL, dribbling, 100, 1e-4, 1e-4),
    "ground kick": Scene(WITH_BALL, kicking(KickMode.GROUND), 60, 1e-4, 1e-4),
    "lob": Scene(WITH_BALL, kicking(KickMode.LOB), 60, 1e-4, 1e-4),
    "loft": Scene(WITH_BALL, kicking(KickMode.LOFT), 60, 1e-4, 1e-4),
    "pushing": Scene(WITH_BALL, pushing, 100, 2e-3, 6e-3),
    "rebounding": Scene(WITH_BALL | {"magenta3": (-4.0, 0.95, 2.0)}, rebounding, 50, 0.015, 0.03),
    "scrambling": Scene(SCRUM, scrambling, 60, 5e-3, 5e-3),
}
"""Times and tolerances, m; where bodies touch, the engine's solver adds its own."""
DRIVES = {
    "velocity": ("velocity",) * 6,
    "traction": ("traction",) * 6,
    "omni": ("omni",) * 6,
    "mixed": ("velocity", "omni", "traction") * 2,
}


def begin(scene: Scene, drives: dict[str, str], mirror: Mirror | None) -> World:
    model = RobotModel.standard(PROFILE)
    models = tuple(replace(model, drive=replace(model.drive, model=drives[name])) for name in NAMES)
    world = World(PROFILE, Roster(NAMES, SIDES, {side: f"{side.value}1" for side in Side}, models), ARENA)
    placements = []
    for body, (x, y, heading) in scene.poses.items():
        if mirror is not None:
            body, x, y = mirror.name(body), mirror.x * x, mirror.y * y
            heading = mirror.left * heading + mirror.turn
        placements.append(Placement(body=body, x=x, y=y, heading=heading))
    world.place(placements)
    return world


def distances(one: Snapshot, other: Snapshot, mirror: Mirror) -> Iterator[float]:
    """How far every body of one world is from where the mirror puts it in the other."""
    for name, robot in zip(NAMES, one.robots, strict=True):
        there = other.robots[NAMES.index(mirror.name(name))]
        yield math.hypot(mirror.x * robot.x - there.x, mirror.y * robot.y - there.y)
    a, b = one.ball, other.ball
    yield math.dist((mirror.x * a.x, mirror.y * a.y, a.z), (b.x, b.y, b.z))


@pytest.mark.parametrize(
    "drives", ["mixed", *(pytest.param(one, marks=pytest.mark.long) for one in DRIVES if one != "mixed")]
)
@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("mirror", [TURNED, REFLECTED], ids=["turned", "reflected"])
def test_a_mirrored_scene_with_mirrored_commands_is_the_mirrored_world(mirror: Mirror, scene: str, drives: str) -> None:
    """No direction of the compass and no side has an advantage."""
    what = SCENES[scene]
    models = dict(zip(NAMES, DRIVES[drives], strict=True))
    mirrored = {mirror.name(name): model for name, model in models.items()}
    one, other = begin(what, models, None), begin(what, mirrored, mirror)
    rest = dict.fromkeys(NAMES, go())
    began = one.snapshot()
    for tick in range(what.ticks):
        told = what.told(tick)
        a = one.advance(rest | told).snapshot
        b = other.advance(rest | {mirror.name(name): mirror.told(said) for name, said in told.items()}).snapshot
        assert a.kicked is None or b.kicked == mirror.name(a.kicked)
    bodies = zip((*began.robots, began.ball), (*a.robots, a.ball), strict=True)
    assert max(math.hypot(now.x - at_first.x, now.y - at_first.y) for at_first, now in bodies) > 0.5
    tolerance = what.turned if mirror.swaps_sides else what.reflected
    assert max(distances(a, b, mirror)) == approx(0.0, abs=tolerance)
    one.close()
    other.close()
