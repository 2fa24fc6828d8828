"""The world over one control tick: moves bodies by the robots' inputs in physics steps, and takes a snapshot."""

from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass
from hashlib import blake2b

from schemas.config.obstacle import ObstacleConfig
from schemas.config.profile import Profile
from schemas.config.roster import Placement
from schemas.messages.applied import AppliedInput
from sim_host.actuation.chassis import Chassis
from sim_host.game.ball_control import Arena, BallReport
from sim_host.physics.collision_candidates import CollisionCandidates
from sim_host.physics.continuous_collision import ContinuousCollision
from sim_host.physics.engine import Engine
from sim_host.physics.impacts import ImpactDetector
from sim_host.snapshot import BALL, BallState, Impact, ObstacleState, RobotState, RobotStates, Roster, Snapshot

_NOTHING = BallReport()


@dataclass(frozen=True, slots=True)
class WorldTick:
    """The result of one tick."""

    snapshot: Snapshot
    refused: dict[str, str]
    """Robot → why its kick could not be carried out."""
    stuck: list[bool]
    """Per robot, in the order of the roster: it is stuck."""


class World:
    """All bodies of a match, with the actuators that move them."""

    def __init__(self, profile: Profile, roster: Roster, arena: Arena, engine: Engine | None = None) -> None:
        """`engine`, if given, was made of the same profile and roster, and has no obstacles yet."""
        self._roster = roster
        self._arena = arena
        self._tick_s = profile.time.tick
        self._engine = engine or Engine(profile, roster, arena.furniture)
        self._chassis = Chassis(profile.time, roster.models, self._engine)
        self._ball = arena.ball_control(profile, roster.models, self._engine)
        self._candidates = CollisionCandidates(profile, roster.models, self._chassis.yielding, self._arena.furniture)
        self._collision = ContinuousCollision(profile, self._engine)
        self.tick = 0
        self._obstacles: tuple[ObstacleState, ...] = ()
        self._chain = b""
        self._read_states()

    def close(self) -> None:
        """Free the engine."""
        self._engine.close()

    def place(self, placements: Sequence[Placement]) -> None:
        """Place bodies between two ticks, at rest unless the placement has a velocity."""
        if not placements:
            return
        self._ball.set_holder(None)
        for placement in placements:
            self._engine.place(placement)
        self._read_placed({placement.body for placement in placements})
        if any(placement.body != BALL for placement in placements):
            self._chassis.reset()
        self._update_obstacles()

    def put_obstacle(self, obstacle: ObstacleConfig) -> None:
        """Add an obstacle with a name that no other has; later changes are made by `rebuild_with`."""
        self._engine.put_obstacle(ObstacleState.of(obstacle))
        self._update_obstacles()

    def _update_obstacles(self) -> None:
        self._obstacles = self._engine.obstacles
        self._candidates.set_obstacles(self._obstacles)

    def make_checkpoint(self) -> None:
        """Make a checkpoint: rebuild the world with the same poses and velocities and no other memory."""
        self._engine.rebuild(self._robots, self._ball_state)
        self._ball.reset(self._ball_state)
        self._engine.read()
        self._chassis.reset()
        self._read_states()

    def rebuild_with(self, profile: Profile, roster: Roster, obstacles: Sequence[ObstacleConfig]) -> None:
        """Rebuild the world with another profile, roster or obstacles; makes a checkpoint.

        Robots, and obstacles that can be pushed, keep their pose and velocity where they remain. New robots stand aside
        until they are placed.
        """
        kept, ball = dict(zip(self._roster.names, self._robots, strict=True)), self._ball_state
        before = self._engine.obstacles
        self._engine.close()
        self._engine = Engine(profile, roster, self._arena.furniture)
        for obstacle in obstacles:
            self._engine.put_obstacle(ObstacleState.of(obstacle))
        self._engine.continue_pushables(before)
        self._chassis = Chassis(profile.time, roster.models, self._engine)
        self._candidates = CollisionCandidates(profile, roster.models, self._chassis.yielding, self._arena.furniture)
        self._collision = ContinuousCollision(profile, self._engine)
        self._update_obstacles()
        new_states = self._engine.robot_states(None)
        self._roster = roster
        self._ball = self._arena.ball_control(profile, roster.models, self._engine)
        robots = [kept.get(name, state) for name, state in zip(roster.names, new_states, strict=True)]
        self._engine.rebuild(robots, ball)
        self._ball.reset(ball)
        self._engine.read()
        self._chassis.reset()
        self._read_states()

    def begin_at(
        self,
        tick: int,
        robots: Sequence[RobotState],
        ball: BallState | None,
        chain: bytes,
        obstacles: Iterable[ObstacleState] = (),
    ) -> None:
        """Continue a history after a tick, with its robots in the order of the roster, its chain and its `obstacles`.

        A checkpoint has to be made before the next tick; it is made from the states given here, bit for bit.
        """
        self.tick, self._robots, self._ball_state, self._chain = tick, RobotStates(robots), ball, chain
        self._engine.continue_pushables(obstacles)
        self._update_obstacles()

    def advance(self, inputs: Mapping[str, AppliedInput]) -> WorldTick:
        """Simulate one control tick."""
        engine, ball = self._engine, self._ball
        ordered = [inputs[name] for name in self._roster.names]
        report = ball.decide_possession_and_kick(self.tick, self._robots, self._ball_state, ordered)
        hits, fixed, touching, meeting = self._candidates.find(self._robots, self._ball_state)
        impacts = ImpactDetector(engine, self._robots, hits) if hits else None
        for drives in self._chassis.plan(self._robots, ordered, touching):
            free_ball = ball.before_step(drives)
            if hits or fixed:
                self._collision.advance_robots(hits, fixed, drives)
            engine.set_velocities(drives)
            if free_ball is not None:
                self._collision.advance_ball(free_ball)
            engine.step()
            if meeting:
                engine.note_robot_contacts()
            ball.after_step(report)
            if impacts is not None:
                impacts.after_step()
        engine.read()
        self._read_states()
        if ball.release_lost_ball(self._robots, self._ball_state):
            self._read_states()
        self.tick += 1
        names = self._roster.names
        return WorldTick(
            snapshot=self.snapshot(report, () if impacts is None else impacts.found()),
            refused={names[place]: reason for place, reason in report.refused.items()},
            stuck=self._chassis.stuck(),
        )

    def snapshot(self, report: BallReport = _NOTHING, impacts: tuple[Impact, ...] = ()) -> Snapshot:
        """The present state of all bodies; `touches`, `level` and `kicked` come from the report of the tick."""
        names, holding = self._roster.names, self._ball.holder
        last_touches = dict.fromkeys(reversed(report.touches))  # each robot once, where it touched last
        return Snapshot(
            tick=self.tick,
            time=self.tick * self._tick_s,
            roster=self._roster,
            robots=self._robots,
            ball_state=self._ball_state,
            possession=None if holding is None else names[holding],
            touches=tuple([names[place] for place in reversed(last_touches)]),
            level=tuple([names[place] for place in report.level]),
            kicked=None if report.kicked is None else names[report.kicked],
            contacts=self._contacts(report),
            impacts=impacts,
            ball_spin=self._engine.ball_spin(),
            obstacles=self._obstacles,
            kickers_ready=self._ball.kickers_ready(self.tick),
        )

    def _contacts(self, report: BallReport) -> tuple[tuple[int, int], ...]:
        """Pairs of robots that touched each other in the tick, also by the ball in the dribbler of one of them."""
        contacts, holder = self._engine.robot_contacts, self._ball.holder
        if holder is None or len(report.touches) < 2:
            return contacts
        through = {(min(holder, other), max(holder, other)) for other in report.touches if other != holder}
        return tuple(sorted({*contacts, *through}))

    def _read_states(self) -> None:
        """Take over the states that the engine has read."""
        if self._engine.has_pushables:
            self._update_obstacles()
        self._robots = self._engine.robot_states(self._ball.holder)
        self._ball_state = self._engine.ball_state()

    def _read_placed(self, placed: Container[str]) -> None:
        """Take over the states of the bodies that were placed; the others keep theirs, and no robot holds the ball.

        The others are not read again: a checkpoint is then made from the same numbers whether the bodies moved there
        or `begin_at` set them.
        """
        states = self._engine.robot_states(None)
        self._robots = RobotStates(
            [
                state if name in placed else before._replace(holding=False)
                for name, state, before in zip(self._roster.names, states, self._robots, strict=True)
            ]
        )
        if BALL in placed:
            self._ball_state = self._engine.ball_state()

    def chain(self, unchained: bytes = b"") -> str:
        """Extend the hash chain by this tick and return it as hex: equal chains mean equal histories.

        The chain covers the state of all bodies, and `unchained`, the recorded inputs that led to it.
        """
        self._chain = blake2b(self._engine.packed() + unchained, key=self._chain, digest_size=32).digest()
        return self._chain.hex()
