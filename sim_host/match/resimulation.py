"""Simulates the world of a recorded match again, without brains, referee or cameras.

Each `schemas.messages.applied.Applied` holds everything that moved the world in its tick: inputs, placements,
and changes of parameters, robots and obstacles. A resimulation begins at tick 0, or at any checkpoint, from poses and
velocities alone: at a checkpoint no robot holds the ball, the ball rolls, every kicker is charged, and wheels turn as
their robot moves.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import msgspec

from schemas.config.obstacle import ObstacleConfig
from schemas.config.profile import STANDARD, Profile, load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.roster import RosterEntry
from schemas.config.sections import TYPE_SECTIONS
from schemas.errors import TouchlineError
from schemas.messages.applied import Applied
from schemas.messages.setup import Setup
from schemas.messages.world import ObstacleTruth
from schemas.messages.world import World as WorldMessage
from schemas.natural_order import natural_order
from schemas.wire.part import encode
from sim_host.game.ball_control import Arena
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.world import World
from sim_host.match.world_fields import Fields, bodies_fields
from sim_host.sensing.random_streams import RandomStreams
from sim_host.sensing.sensors.suite import SensorSuite
from sim_host.snapshot import BALL, BallState, ObstacleState, Pushed, RobotState, Roster, Snapshot


class ImpossibleTickError(TouchlineError):
    """A recorded tick is impossible: no host can have applied it."""


@dataclass(frozen=True, slots=True)
class Conditions:
    """Parameters, robots and obstacles of a match at one tick."""

    live_parameters: LiveParameters
    robots: tuple[RosterEntry, ...] = ()
    """In the order of the roster."""
    obstacles: tuple[ObstacleConfig, ...] = ()

    def after(self, applied: Applied) -> "Conditions":
        """The conditions after the changes of a tick.

        Raises:
            ImpossibleTickError: the tick changes a parameter that does not exist, or sets an impossible value.
        """
        if not applied.parameters and applied.robots is None and applied.obstacles is None:
            return self
        try:
            live_parameters = (
                self.live_parameters.with_settings(applied.parameters) if applied.parameters else self.live_parameters
            )
        except (KeyError, TypeError, TouchlineError) as error:
            raise ImpossibleTickError(f"tick {applied.tick}: parameters that cannot be set ({error})") from None
        return Conditions(
            live_parameters,
            self.robots if applied.robots is None else tuple(applied.robots),
            self.obstacles if applied.obstacles is None else tuple(applied.obstacles),
        )

    def roster(self) -> Roster:
        """The robots with the models of their types.

        Raises:
            ImpossibleTickError: a robot has an unknown type, or there is no robot.
        """
        if not self.robots:
            raise ImpossibleTickError("no robot takes part")
        try:
            return Roster.of_entries(self.robots, self.live_parameters.types)
        except KeyError as error:
            raise ImpossibleTickError(f"a robot has the type {error}, which neither profile nor match has") from None


class CheckpointState(NamedTuple):
    """The state at the tick before a checkpoint."""

    world: WorldMessage
    chain: str
    """Hex."""


class ResimulatedTick(NamedTuple):
    """One tick of a resimulation."""

    bodies: Fields
    """The world, as `sim_host.match.world_fields.bodies_fields` returns it; with `sensors` where the seed is known."""
    chain: str
    snapshot: Snapshot
    profile: Profile
    """The numbers in force in this tick."""


def parameters_of(setup: Setup) -> LiveParameters:
    """The parameters that a host reports in its setup.

    Those of sensors and radio, which do not affect the world, are the shipped ones. A type's parameter that equals the
    standard robot's is taken to follow it.
    """
    shipped = load_profile("msl")
    profile = replace(
        shipped,
        name=setup.profile,
        time=setup.time,
        field=setup.pitch,
        robot=setup.robot,
        ball=setup.ball,
        drive=setup.drive,
        wheels=setup.models[STANDARD].wheels,
        dribble=setup.dribble,
        kicker=setup.kicker,
        camera=setup.camera,
        types={},
    )
    own = RobotModel.standard(profile)
    types = {name: _differences(model, own) for name, model in setup.models.items() if name != STANDARD}
    profile = replace(profile, types=types)
    return LiveParameters(profile, "profile", profile, "profile")


def _differences(model: RobotModel, standard: RobotModel) -> dict[str, dict[str, object]]:
    """Section → key → value, where a type differs from the standard robot."""
    found: dict[str, dict[str, object]] = {}
    for section in TYPE_SECTIONS:
        attribute = "body" if section == "robot" else section
        mine, other = getattr(model, attribute), getattr(standard, attribute)
        changed = {key: getattr(mine, key) for key in mine.__slots__ if getattr(mine, key) != getattr(other, key)}
        if changed:
            found[section] = changed
    return found


class Resimulation:
    """Simulates a recorded match again, tick by tick."""

    def __init__(
        self,
        arena: Arena,
        initial: Conditions,
        checkpoint: CheckpointState | None = None,
        seed: int | None = None,
    ) -> None:
        """`initial` and `checkpoint` are of the tick before the first one; `checkpoint` is None to begin at tick 0.

        With the `seed` of the match, the sensors of the table are read again, too.
        """
        self._streams = RandomStreams(seed) if seed is not None else None
        self._sensors: SensorSuite | None = None
        self._arena = arena
        self._conditions = initial
        self._checkpoint = checkpoint
        self._names: set[str] = set()
        self._world: World | None = None

    def close(self) -> None:
        """Free the engine."""
        if self._world is not None:
            self._world.close()

    def step(self, applied: Applied, unchained: bytes) -> ResimulatedTick:
        """Simulate the next tick. `unchained` is the part of its message that enters the chain (`chained_part_of`).

        Raises:
            ImpossibleTickError: no host can have applied this tick.
        """
        try:
            return self._step(applied, unchained)
        except ImpossibleTickError:
            raise
        except (ArithmeticError, LookupError, ValueError) as error:  # values that no host wrote may be out of range
            raise ImpossibleTickError(f"tick {applied.tick}: {type(error).__name__} ({error})") from None

    def _step(self, applied: Applied, unchained: bytes) -> ResimulatedTick:
        before, after = self._conditions, self._conditions.after(applied)
        world = self._world
        if world is None:
            world = self._world = self._new_world(before if self._checkpoint is not None else after)
        self._conditions = after
        if applied.remade or (after.robots != before.robots and applied.tick > 0):
            world.rebuild_with(after.live_parameters.profile, self._roster_of(after), after.obstacles)
        self._check(applied)
        world.place(applied.placements)
        if applied.tick == 0:
            snapshot = world.snapshot()
            stuck = [False] * len(snapshot.robots)
        else:
            if applied.checkpoint:
                world.make_checkpoint()
            world_tick = world.advance(applied.inputs)
            snapshot, stuck = world_tick.snapshot, world_tick.stuck
        chain, profile = world.chain(unchained), after.live_parameters.profile
        bodies = bodies_fields(snapshot, stuck)
        if self._sensors is not None:
            self._sensors.at(snapshot)
            bodies["sensors"] = msgspec.json.decode(encode(self._sensors.fresh))
        return ResimulatedTick(bodies, chain, snapshot, profile)

    def _new_world(self, conditions: Conditions) -> World:
        """The world before the first tick of the resimulation."""
        roster = self._roster_of(conditions)
        world = World(conditions.live_parameters.profile, roster, self._arena)
        for obstacle in conditions.obstacles:
            world.put_obstacle(obstacle)
        if self._checkpoint is not None:
            before, chain = self._checkpoint
            robots, ball = _states(before, roster)
            obstacles = [_obstacle(name, one) for name, one in before.obstacles.items()]
            world.begin_at(before.tick, robots, ball, bytes.fromhex(chain), obstacles)
        return world

    def _roster_of(self, conditions: Conditions) -> Roster:
        """The robots with the models of their types."""
        roster = conditions.roster()
        self._names = set(roster.names)
        profile = conditions.live_parameters.profile
        if profile.sensors and self._streams is not None:
            self._sensors = SensorSuite(profile, roster, self._streams)
        return roster

    def _check(self, applied: Applied) -> None:
        names = self._names
        if applied.tick > 0 and applied.inputs.keys() != names:
            odd = ", ".join(sorted(applied.inputs.keys() ^ names, key=natural_order))
            raise ImpossibleTickError(f"tick {applied.tick}: inputs do not match the robots that take part: {odd}")
        movable = {*names, *(one.name for one in self._conditions.obstacles if one.mass is not None)}
        for placement in applied.placements:
            if placement.body not in movable and placement.body != BALL:
                raise ImpossibleTickError(f"tick {applied.tick}: {placement.body} is placed, but does not take part")


def _states(world: WorldMessage, roster: Roster) -> tuple[list[RobotState], BallState | None]:
    if world.robots.keys() != set(roster.names):
        odd = ", ".join(sorted(world.robots.keys() ^ set(roster.names), key=natural_order))
        raise ImpossibleTickError(f"tick {world.tick}: the world does not match the robots that take part: {odd}")
    robots = []
    for name in roster.names:
        its = world.robots[name]
        robots.append(RobotState(its.x, its.y, its.z, its.heading, its.vx, its.vy, its.omega, holding=False))
    ball = world.ball
    return robots, BallState(ball.x, ball.y, ball.z, ball.vx, ball.vy, ball.vz) if ball is not None else None


def _obstacle(name: str, one: ObstacleTruth) -> ObstacleState:
    pushed = None if one.pushed is None else Pushed(**one.pushed.plain())
    sizes = one.radius, one.height, one.shape, one.size_x, one.size_y
    return ObstacleState(name, one.x, one.y, one.heading, *sizes, pushed)
