"""The layout of a match: its robots, its obstacles, and the places of all bodies; every operation makes a new one."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from schemas.config.obstacle import ObstacleConfig, Shape
from schemas.config.robot_model import RobotModel
from schemas.config.roster import Placement, RosterEntry
from schemas.config.scene import Scene, SceneGame, check_names, check_sides
from schemas.config.sections import Ball, Pitch
from schemas.errors import TouchlineError, did_you_mean
from schemas.side import Side
from sim_host.physics.pitch import SOCCER, Furniture
from sim_host.snapshot import BALL
from sim_host.staging.overlap import Block, Body, Disc, goal_blocks, why_outside, why_overlapping


@dataclass(frozen=True, slots=True)
class Specs:
    """The properties of a match that no operation changes: pitch, ball, robot types, and sizes of teams."""

    pitch: Pitch
    ball: Ball
    types: Mapping[str, RobotModel]
    """All robot types by name."""
    check_team_sizes: Callable[[Sequence[RosterEntry]], None]
    """Raises a `TouchlineError` where a side has more robots than the game allows."""
    furniture: Furniture = SOCCER


@dataclass(frozen=True, slots=True)
class Layout:
    """Everything on the pitch, from the next tick on."""

    robots: tuple[RosterEntry, ...]
    """In the order of the roster."""
    obstacles: tuple[ObstacleConfig, ...]
    at: Mapping[str, Placement]
    """Robot, ball, or obstacle that can be pushed → where it is, or is about to be placed."""

    @property
    def names(self) -> list[str]:
        """Robots, obstacles, and the ball where there is one."""
        ball = [BALL] if BALL in self.at else []
        return [*(entry.name for entry in self.robots), *(one.name for one in self.obstacles), *ball]

    @property
    def movable(self) -> list[str]:
        """What can be placed: robots, obstacles that can be pushed, and the ball."""
        pushed = [one.name for one in self.obstacles if one.mass is not None]
        return [name for name in self.names if name in self.at or name in pushed]


@dataclass(frozen=True, slots=True)
class LayoutChange:
    """The result of an operation."""

    layout: Layout
    summary: str
    """What the operation does, as the predicate of a sentence."""
    placements: list[Placement] = field(default_factory=list)
    game: SceneGame | None = None
    """The game with which a new episode begins; None if the game goes on."""

    @property
    def ball(self) -> tuple[float, float]:
        """Position of the ball on the ground, m; the centre without one."""
        at = self.layout.at.get(BALL)
        return (at.x, at.y) if at is not None else (0.0, 0.0)


def in_roster_order(robots: Sequence[RosterEntry]) -> tuple[RosterEntry, ...]:
    """The robots in the order of a roster: cyan's, then magenta's, each side's goalkeeper first."""
    sides = list(Side)
    return tuple(sorted(robots, key=lambda entry: (sides.index(entry.side), not entry.keeper)))


def scene_layout(scene: Scene, furniture: Furniture, summary: str) -> LayoutChange:
    """The change that begins a scene; the layout is not checked."""
    placements = [robot.placement for robot in scene.robots]
    placements += [one.placement for one in scene.obstacles if one.mass is not None]
    placements += [scene.ball.placement] if furniture.ball else []
    robots = in_roster_order([robot.entry for robot in scene.robots])
    layout = Layout(robots, tuple(scene.obstacles), {one.body: one for one in placements})
    return LayoutChange(layout, summary, placements, scene.game)


def check_layout(layout: Layout, specs: Specs, new: Sequence[str]) -> None:
    """Check that a layout is possible; places are checked for the bodies in `new` only.

    Raises:
        TouchlineError: the layout is impossible, with the reason.
    """
    try:
        check_names([name for name in layout.names if name != BALL])
        check_sides(list(layout.robots))
    except ValueError as error:
        raise TouchlineError(str(error)) from None
    specs.check_team_sizes(layout.robots)
    if not layout.robots:
        raise TouchlineError("no robot would be left; a match has at least one")
    for entry in layout.robots:
        if entry.type not in specs.types:
            raise TouchlineError(f'{entry.name} has the type "{entry.type}"; {did_you_mean(entry.type, specs.types)}')
    bodies = _bodies(layout, specs)
    movable = [body for name, body in bodies.items() if name in layout.at and isinstance(body, Disc)]
    goals = goal_blocks(specs.pitch) if specs.furniture.goals else []
    for name in new:
        body = bodies[name]
        fault = why_outside(specs.pitch, body) if name in layout.at else None
        if name in layout.at and isinstance(body, Disc):
            others = [other for other in bodies.values() if other is not body]
            fault = fault or why_overlapping(body, [*others, *goals])
        else:  # obstacles may overlap each other
            fault = fault or next(filter(None, [why_overlapping(other, [body]) for other in movable]), None)
        if fault is not None:
            raise TouchlineError(fault)


def _bodies(layout: Layout, specs: Specs) -> dict[str, Body]:
    bodies: dict[str, Body] = {}
    for entry in layout.robots:
        hull, at = specs.types[entry.type].body, layout.at[entry.name]
        bodies[entry.name] = Disc(entry.name, at.x, at.y, hull.reach, 0.0, hull.height, core=hull.radius)
    for one in layout.obstacles:
        bodies[one.name] = obstacle_body(one, layout.at.get(one.name, one.placement))
    if BALL in layout.at:
        radius, at = specs.ball.radius, layout.at[BALL]
        height = radius if at.z is None else at.z
        bodies[BALL] = Disc("the ball", at.x, at.y, radius, height - radius, height + radius, is_ball=True)
    return bodies


def obstacle_body(one: ObstacleConfig, at: Placement) -> Body:
    """An obstacle at a place, for `overlap`."""
    long, wide, high = one.extents
    if one.shape is Shape.CYLINDER:
        return Disc(one.name, at.x, at.y, long / 2, 0.0, high)
    return Block(one.name, at.x, at.y, at.heading, long / 2, wide / 2, 0.0, high)


def with_placements(layout: Layout, placements: Sequence[Placement]) -> Layout:
    """The layout with bodies moved to these placements."""
    return replace(layout, at={**layout.at, **{one.body: one for one in placements}})
