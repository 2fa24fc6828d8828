"""The stage: who takes part, what stands on the pitch, and where; every deed makes a new one."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from schemas.errors import TouchlineError, did_you_mean
from schemas.obstacle import Shape, StaticObstacle
from schemas.robot_model import RobotModel
from schemas.roster import Placement, RosterEntry
from schemas.scene import Scene, SceneGame, check_names, check_sides
from schemas.sections import Ball, Field
from schemas.side import Side
from sim_host.staging.room import Block, Body, Disc, goal_blocks, in_the_way, outside

BALL = "ball"


@dataclass(frozen=True, slots=True)
class Rig:
    """What of a match does not change by a deed, and what bodies look like."""

    pitch: Field
    ball: Ball
    types: Mapping[str, RobotModel]
    """Every type that a robot may have."""


@dataclass(frozen=True, slots=True)
class Stage:
    """Everything on the pitch, from the next tick on."""

    robots: tuple[RosterEntry, ...]
    """In the order of the roster."""
    obstacles: tuple[StaticObstacle, ...]
    at: Mapping[str, Placement]
    """Robot or ball → where it is, or is going to be set down."""

    @property
    def names(self) -> list[str]:
        """Robots, obstacles, and the ball."""
        return [*(entry.name for entry in self.robots), *(one.name for one in self.obstacles), BALL]


@dataclass(frozen=True, slots=True)
class Staged:
    """What a deed comes to."""

    stage: Stage
    says: str
    """What is done, as the end of a sentence."""
    placements: list[Placement] = field(default_factory=list)
    game: SceneGame | None = None
    """What the game becomes; nothing where it goes on. The world begins anew, and nothing of before counts."""

    @property
    def ball(self) -> tuple[float, float]:
        """Where the ball is on the ground, m."""
        at = self.stage.at[BALL]
        return at.x, at.y


def ordered(robots: Sequence[RosterEntry]) -> tuple[RosterEntry, ...]:
    """In the order of a roster: cyan's, then magenta's, each side's goalkeeper first."""
    sides = list(Side)
    return tuple(sorted(robots, key=lambda entry: (sides.index(entry.side), not entry.keeper)))


def opened(scene: Scene, says: str) -> Staged:
    """A scene from its beginning, possible or not."""
    placements = [*(robot.placement for robot in scene.robots), scene.ball.placement]
    robots = ordered([robot.entry for robot in scene.robots])
    stage = Stage(robots, tuple(scene.obstacles), {one.body: one for one in placements})
    return Staged(stage, says, placements, scene.game)


def check(stage: Stage, rig: Rig, new: Sequence[str]) -> None:
    """Make sure that a stage is possible; of bodies, those that are `new` are looked at.

    Raises:
        TouchlineError: it is not, in one sentence.
    """
    try:
        check_names([name for name in stage.names if name != BALL])
        check_sides(list(stage.robots))
    except ValueError as error:
        raise TouchlineError(str(error)) from None
    if not stage.robots:
        raise TouchlineError("nobody would be left; a match has one robot at least")
    for entry in stage.robots:
        if entry.type not in rig.types:
            raise TouchlineError(f'{entry.name} has the type "{entry.type}"; {did_you_mean(entry.type, rig.types)}')
    bodies = _bodies(stage, rig)
    movable = [body for name, body in bodies.items() if name in stage.at and isinstance(body, Disc)]
    goals = goal_blocks(rig.pitch)
    for name in new:
        body = bodies[name]
        if name in stage.at and isinstance(body, Disc):
            others = [other for other in bodies.values() if other is not body]
            fault = outside(rig.pitch, body) or in_the_way(body, [*others, *goals])
        else:  # obstacles may stand in each other
            fault = next(filter(None, [in_the_way(other, [body]) for other in movable]), None)
        if fault is not None:
            raise TouchlineError(fault)


def _bodies(stage: Stage, rig: Rig) -> dict[str, Body]:
    bodies: dict[str, Body] = {}
    for entry in stage.robots:
        hull, at = rig.types[entry.type].body, stage.at[entry.name]
        bodies[entry.name] = Disc(entry.name, at.x, at.y, hull.reach, 0.0, hull.height, core=hull.radius)
    for one in stage.obstacles:
        bodies[one.name] = _obstacle(one)
    radius, at = rig.ball.radius, stage.at[BALL]
    height = radius if at.z is None else at.z
    bodies[BALL] = Disc("the ball", at.x, at.y, radius, height - radius, height + radius, is_ball=True)
    return bodies


def _obstacle(one: StaticObstacle) -> Body:
    (x, y), (long, wide, high) = one.place, one.extents
    if one.shape is Shape.CYLINDER:
        return Disc(one.name, x, y, long / 2, 0.0, high)
    return Block(one.name, x, y, one.heading, long / 2, wide / 2, 0.0, high)


def moved(stage: Stage, placements: Sequence[Placement]) -> Stage:
    """The stage with bodies set down."""
    return replace(stage, at={**stage.at, **{one.body: one for one in placements}})
