"""The physics engine: poses, velocities and steps."""

import math
import struct
import weakref
from collections.abc import Iterable, Sequence
from itertools import chain
from typing import Any

from schemas.config.profile import Profile
from schemas.config.rolling import GRAVITY
from schemas.config.roster import Placement
from schemas.errors import NoBallError
from schemas.frames import wrap
from sim_host.physics import contacts
from sim_host.physics.bodies import NO_TURN, BodyMaker, surface_restitution, upright
from sim_host.physics.body_state import BallContacts, BodyState, Gap
from sim_host.physics.bounce import MIN_BOUNCE_SPEED
from sim_host.physics.bullet import pybullet, release_client, take_client
from sim_host.physics.pitch import SOCCER, Furniture
from sim_host.physics.pushables import Pushable, inertia
from sim_host.physics.vectors import FieldTwist, Vector
from sim_host.snapshot import BALL, BallState, ObstacleState, RobotState, RobotStates, Roster

_ITERATIONS = 200
"""Maximum of the solver; with Bullet's 50, two robots press a ball, of a hundredth of their mass, into their hulls."""
_UPRIGHT = 1e-3
"""A robot is put upright again from this half sine of its tilt, or from this lift in m."""
_STATE_SIZE = 13
"""Numbers in the state of a body."""
_OBSTACLE = struct.Struct("<7d")

_ZERO: Vector = (0.0, 0.0, 0.0)


class Engine:
    """One physical world; bodies are addressed by their index in the roster."""

    def __init__(self, profile: Profile, roster: Roster, furniture: Furniture = SOCCER) -> None:
        self._profile = profile
        self._furniture = furniture
        self.names = roster.names
        self._models = roster.models
        self.restitution = max([surface_restitution(model.body, profile) for model in roster.models], default=0.0)
        """Of the robots' surfaces, the largest: see `surface_restitution`."""
        self._heights = [model.body.height / 2 for model in roster.models]
        self.client = take_client()
        self._free = weakref.finalize(self, release_client, self.client)
        self._free.atexit = False  # the process frees its memory by itself
        self._make = BodyMaker(self.client, profile)
        self._lift = GRAVITY * profile.time.physics_step
        self._ball_now: BodyState | None = None
        """The state of the ball; None when it has to be read again."""
        self._noted_contacts: set[tuple[int, int]] = set()
        self._obstacles: dict[str, tuple[ObstacleState, int]] = {}
        """Name → the obstacle as it was put there, and its body, in the order in which they were added."""
        self._pushables: dict[str, Pushable] = {}
        self._build()

    def close(self) -> None:
        """Leave the engine's memory to the next engine, without waiting until Python collects this object."""
        self._free()

    def _build(self) -> None:
        client, profile = self.client, self._profile
        pybullet.resetSimulation(physicsClientId=client)
        pybullet.setGravity(0, 0, -GRAVITY, physicsClientId=client)
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=profile.time.physics_step,
            deterministicOverlappingPairs=1,
            restitutionVelocityThreshold=MIN_BOUNCE_SPEED,
            useSplitImpulse=1,  # a body pushed out of another gains no speed by it
            numSolverIterations=_ITERATIONS,
            physicsClientId=client,
        )
        make = self._make
        self._ground = make.ground()
        self._boxes = list(make.pitch(with_goals=self._furniture.goals))
        self.robots = [make.robot(place, model, self._ground) for place, model in enumerate(self._models)]
        self._robot_of = {body: place for place, body in enumerate(self.robots)}
        self._balls = [make.ball()] if self._furniture.ball else []
        kept = self.obstacles
        self._obstacles, self._pushables = {}, {}
        for obstacle in kept:
            self.put_obstacle(obstacle)
        self._ball_ignores: int | None = None
        self.read()

    @property
    def obstacles(self) -> tuple[ObstacleState, ...]:
        """All obstacles, in the order in which they were added; those that can be pushed as last read."""
        pushables = self._pushables
        return tuple(
            [pushables[name].obstacle if name in pushables else at for name, (at, _) in self._obstacles.items()]
        )

    @property
    def has_pushables(self) -> bool:
        """Whether an obstacle can be pushed."""
        return bool(self._pushables)

    def put_obstacle(self, obstacle: ObstacleState) -> None:
        """Add an obstacle with a name that no other has."""
        pushed = obstacle.pushed
        if pushed is None:
            body = self._make.obstacle(obstacle)
        else:
            moments = inertia(obstacle, pushed.mass)
            body = self._make.pushable(obstacle, pushed.mass, moments, self._ground)
            pushable = Pushable(self.client, body, obstacle, pushed, self._profile.time.physics_step)
            pushable.continue_from(obstacle)
            self._pushables[obstacle.name] = pushable
        self._obstacles[obstacle.name] = obstacle, body

    def continue_pushables(self, obstacles: Iterable[ObstacleState]) -> None:
        """Let obstacles that can be pushed go on with the poses and velocities of those of the same names."""
        for obstacle in obstacles:
            if obstacle.pushed is not None and obstacle.name in self._pushables:
                self._pushables[obstacle.name].continue_from(obstacle)

    @property
    def ball(self) -> int:
        """The body of the ball.

        Raises:
            NoBallError: the game has none.
        """
        if not self._balls:
            raise NoBallError
        return self._balls[0]

    def rebuild(self, robots: Sequence[RobotState], ball: BallState | None) -> None:
        """Rebuild the world with these poses and velocities: robots upright, the ball without spin and not held.

        Its future then depends on these numbers alone: contact caches and warm starts are cleared.
        """
        self._build()
        for body, height, robot in zip(self.robots, self._heights, robots, strict=True):
            velocity, spin = (robot.vx, robot.vy, 0.0), (0.0, 0.0, robot.omega)
            self.set_state(body, BodyState((robot.x, robot.y, height), upright(robot.heading), velocity, spin))
        if ball is not None:
            position, velocity = (ball.x, ball.y, ball.z), (ball.vx, ball.vy, ball.vz)
            self.set_state(self.ball, BodyState(position, NO_TURN, velocity, _ZERO))
        self.read()

    def state(self, body: int) -> BodyState:
        """The state of a body between two steps."""
        client = self.client
        return BodyState(*pybullet.getBasePositionAndOrientation(body, client), *pybullet.getBaseVelocity(body, client))

    def set_state(self, body: int, state: BodyState) -> None:
        """Set the state of a body, without updating the states that were read."""
        self._ball_now = None
        pybullet.resetBasePositionAndOrientation(body, state.position, state.orientation, self.client)
        pybullet.resetBaseVelocity(body, state.velocity, state.spin, self.client)

    def place(self, placement: Placement) -> None:
        """Place a robot, the ball or an obstacle that can be pushed, at rest or with a velocity, and read its state."""
        if placement.body == BALL:
            height = self._profile.ball.radius if placement.z is None else placement.z
            velocity = (placement.vx, placement.vy, placement.vz)
            self.set_state(self.ball, BodyState((placement.x, placement.y, height), NO_TURN, velocity, _ZERO))
            self._states[-1] = self.state(self.ball)
            return
        twist = (placement.vx, placement.vy, placement.omega)
        if placement.body in self._pushables:
            self._pushables[placement.body].set(placement.x, placement.y, placement.heading, twist)
            return
        place = self.names.index(placement.body)
        position = (placement.x, placement.y, self._heights[place])
        velocity, spin = (placement.vx, placement.vy, 0.0), (0.0, 0.0, placement.omega)
        self.set_state(self.robots[place], BodyState(position, upright(placement.heading), velocity, spin))
        self._states[place] = self.state(self.robots[place])

    def read(self) -> None:
        """Read the state of all bodies; a robot that was lifted or tipped is put upright first."""
        self._states = [self.state(body) for body in (*self.robots, *self._balls)]
        """Of all robots, then of the ball."""
        self._ball_now = self._states[-1] if self._balls else None
        for pushable in self._pushables.values():
            pushable.read()
        self.robot_contacts = tuple(sorted(self._noted_contacts | self._robot_contacts()))
        """Pairs of robots that touched in the last step or in a noted one; sorted, the smaller index first."""
        self._noted_contacts.clear()
        for place, (body, height) in enumerate(zip(self.robots, self._heights, strict=True)):
            position, (qx, qy, qz, qw), velocity, spin = self._states[place]
            if abs(qx) > _UPRIGHT or abs(qy) > _UPRIGHT or abs(position[2] - height) > _UPRIGHT:
                at, moving = self._upright_centre(place), (velocity[0], velocity[1], 0.0)
                self.set_state(body, BodyState(at, upright(2.0 * math.atan2(qz, qw)), moving, (0.0, 0.0, spin[2])))
                self._states[place] = self.state(body)

    def _upright_centre(self, place: int) -> Vector:
        """The centre of a tipped robot once it is upright: where it is, or near a ball as seen at the ball's height.

        A pressed ball is light and touches a hull near its foot or near its top, so that the solver tips the robot
        rather than stops it. A robot put upright about its centre would then come down into the ball.
        """
        ((x, y, _), (qx, qy, qz, qw), *_), height = self._states[place], self._heights[place]
        if not self._balls:
            return x, y, height
        ball_x, ball_y, ball_z = self._states[-1].position
        if math.hypot(ball_x - x, ball_y - y) < self._models[place].body.reach + 2.0 * self._profile.ball.radius:
            below = height - min(ball_z, 2.0 * height)
            x, y = x - below * 2.0 * (qx * qz + qw * qy), y - below * 2.0 * (qy * qz - qw * qx)
        return x, y, height

    def robot_states(self, holding: int | None) -> RobotStates:
        """The states of all robots, as last read."""
        robots = self._states[: len(self.robots)]
        return RobotStates([_robot_state(state, place == holding) for place, state in enumerate(robots)])

    def ball_state(self) -> BallState | None:
        """The state of the ball, as last read; None without one."""
        if not self._balls:
            return None
        position, _, velocity, _ = self._states[-1]
        return BallState(*position, *velocity)

    def ball_spin(self) -> tuple[float, float]:
        """The ball's spin about x and y in rad/s, as last read; 0 without a ball."""
        return self._states[-1].spin[:2] if self._balls else (0.0, 0.0)

    def packed(self) -> bytes:
        """Robots, ball and obstacles, as last read, as little-endian doubles: equal bytes mean equal worlds."""
        states = [*self._states, *[pushable.state() for pushable in self._pushables.values()]]
        numbers = chain.from_iterable(chain.from_iterable(states))
        bodies = struct.pack(f"<{_STATE_SIZE * len(states)}d", *numbers)
        return b"".join([bodies, *[_pack(obstacle) for obstacle, _ in self._obstacles.values()]])

    def robot_now(self, place: int) -> RobotState:
        """The state of a robot between two steps, as one that holds the ball."""
        return _robot_state(self.state(self.robots[place]), True)

    def robot_twist(self, place: int) -> FieldTwist:
        """The velocity of a robot between two steps."""
        (vx, vy, _), (_, _, omega) = pybullet.getBaseVelocity(self.robots[place], self.client)
        return vx, vy, omega

    def ball_now(self) -> BodyState:
        """The state of the ball between two steps."""
        if self._ball_now is None:
            self._ball_now = self.state(self.ball)
        return self._ball_now

    def set_velocities(self, velocities: Sequence[FieldTwist]) -> None:
        """Set every robot's velocity in the field frame, (vx, vy, omega), for the next step; brake what is pushed."""
        lift, client, reset = self._lift, self.client, pybullet.resetBaseVelocity
        for body, (vx, vy, omega) in zip(self.robots, velocities, strict=True):
            reset(body, (vx, vy, lift), (0.0, 0.0, omega), client)
        for pushable in self._pushables.values():
            pushable.brake()

    def fixed_bodies(self) -> list[int]:
        """Bodies other than robots, ball and ground: the boxes of the pitch, then the obstacles."""
        return self._boxes + [body for _, body in self._obstacles.values()]

    def pushed_twists(self) -> dict[int, FieldTwist]:
        """Body of each obstacle that can be pushed → its velocity between two steps."""
        return {pushable.body: pushable.twist() for pushable in self._pushables.values()}

    def gap(self, one: int, other: int, within: float) -> Gap | None:
        """The gap between the nearest points of two bodies; None if they are more than `within` m apart."""
        near = pybullet.getClosestPoints(one, other, within, physicsClientId=self.client)
        if not near:
            return None
        point = min(near, key=_distance_of)
        return Gap(point[5], point[6], point[7], point[8])

    def bodies_near_ball(self, low: Sequence[float], high: Sequence[float]) -> list[int]:
        """Bodies, other than the ground, that may reach into the box between two corners and collide with the ball."""
        found = pybullet.getOverlappingObjects(low, high, physicsClientId=self.client) or ()
        passes = {*self._balls, self._ground, None if self._ball_ignores is None else self.robots[self._ball_ignores]}
        return sorted({body for body, _ in found} - passes)

    def set_ball_motion(self, velocity: Vector, spin: Vector) -> None:
        """Set the ball's velocity and spin."""
        self._ball_now = None
        pybullet.resetBaseVelocity(self.ball, velocity, spin, self.client)

    def set_ball_state(self, position: Vector, velocity: Vector, spin: Vector) -> None:
        """Set the ball's position, velocity and spin."""
        self.set_state(self.ball, BodyState(position, NO_TURN, velocity, spin))

    def push_ball(self, force: Vector, at: Vector) -> None:
        """Apply a force in N at the ball's centre `at`, for the next step."""
        pybullet.applyExternalForce(self.ball, -1, force, at, pybullet.WORLD_FRAME, self.client)

    def ignore_ball_contacts(self, robot: int | None) -> None:
        """Let the ball not collide with this robot, or collide with all: a held ball lies a little inside the hull."""
        if robot == self._ball_ignores:
            return
        for place, collide in ((self._ball_ignores, 1), (robot, 0)):
            if place is not None:
                pybullet.setCollisionFilterPair(
                    self.robots[place], self.ball, -1, -1, collide, physicsClientId=self.client
                )
        self._ball_ignores = robot

    def step(self) -> None:
        """Simulate one physics step."""
        self._ball_now = None
        pybullet.stepSimulation(self.client)

    def ball_contacts(self, holder: int | None) -> BallContacts:
        """The ball's contacts in the last step, other than with the ground; depth in its holder does not count."""
        return contacts.of_ball(self.client, self.ball, self._ground, self.robots, holder)

    def contact_direction(self, one: int, other: int) -> tuple[float, float] | None:
        """The unit vector on the ground from one robot to another at their contact in the last step; None without one.

        For two round hulls it is the direction from centre to centre.
        """
        return contacts.direction(self.client, self.robots[one], self.robots[other])

    def note_robot_contacts(self) -> None:
        """Note the robots that touched each other in the last step: after a rebound they no longer do."""
        self._noted_contacts |= self._robot_contacts()

    def _robot_contacts(self) -> set[tuple[int, int]]:
        """Pairs of robots that touched each other in the last step, the smaller index first."""
        return contacts.of_robots(self.client, self._robot_of)


def _pack(obstacle: ObstacleState) -> bytes:
    o = obstacle
    return o.name.encode() + _OBSTACLE.pack(o.x, o.y, o.heading, o.radius, o.height, o.size_x, o.size_y)


def _robot_state(state: BodyState, holding: bool) -> RobotState:
    (x, y, z), (_, _, qz, qw), (vx, vy, _), (_, _, omega) = state
    return RobotState(x, y, z, wrap(2.0 * math.atan2(qz, qw)), vx, vy, omega, holding)


def _distance_of(point: tuple[Any, ...]) -> float:
    distance: float = point[8]
    return distance
