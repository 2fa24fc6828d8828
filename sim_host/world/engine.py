"""The physics engine behind one door: bodies, velocities, steps and contacts; the only module that knows PyBullet.

Robots are upright cylinders, some with a frame across their front, that roll on wheels no ground contact could stand
for: the engine does not collide them with the ground, their weight is carried, and what drives them is set as
velocity. They collide with each other, the ball, the goals, the boundary and the obstacles.
"""

import importlib.metadata
import math
import struct
from collections.abc import Sequence
from typing import Any, NamedTuple

import pybullet

from schemas.frames import wrap
from schemas.host import Placement
from schemas.obstacle import Shape
from schemas.profile import Profile, RobotBody
from schemas.robot_model import RobotModel
from sim_host.actuation.bounce import NO_BOUNCE
from sim_host.snapshot import BallState, ObstacleState, RobotState, Roster
from sim_host.world.gravity import GRAVITY
from sim_host.world.impact import DEEP
from sim_host.world.pitch import Box, boundary, goals

_WALL_RESTITUTION = 0.5
_NET_RESTITUTION = 0.0
"""A net takes what speed the ball has against it, and gives no spin."""
_ITERATIONS = 200
"""At most; with Bullet's 50 two robots press a ball, a hundredth of their weight, deep into each other."""
_TOUCHES = 1e-3
"""m; nearer than this the ball is in contact. Bullet would brake it 2 cm before it touches, and spoil its bounce."""
_UPRIGHT = 1e-3
"""Half the sine of the tilt, and the m of lift, from which a robot is put upright again."""
_TOUCHING = 0.001
"""m of air between two robots that count as touching: the solver leaves less than that."""
_BROUGHT_TO = 0.001
"""m by which bodies overlap that are brought together: enough for the engine to find the contact."""
_STIRS = 0.03
"""m that a robot may move in a step."""
_APPROACHES = 6
"""Rounds in which a ball comes to touch a hull that it meets off its axis."""
_TOP_SPEED = 60.0
"""m/s; no two bodies close in faster: twice the most that a drive may have, and the turn of their frames."""
_STATE = struct.Struct("<13d")
_OBSTACLE = struct.Struct("<7d")

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

_NOTHING: Vector = (0.0, 0.0, 0.0)
_NO_TURN: Quaternion = (0.0, 0.0, 0.0, 1.0)


class BodyState(NamedTuple):
    """What determines a body's future: position m, orientation quaternion xyzw, velocity m/s, spin rad/s."""

    position: Vector
    orientation: Quaternion
    velocity: Vector
    spin: Vector


class Engine:
    """One physical world; bodies are addressed by their place in the roster."""

    def __init__(self, profile: Profile, roster: Roster) -> None:
        self._profile = profile
        self.names = roster.names
        self._models = roster.models
        self._heights = [model.body.height / 2 for model in roster.models]
        self.client = pybullet.connect(pybullet.DIRECT)
        self._lift = GRAVITY * profile.time.physics_step
        self._fast = DEEP / profile.time.physics_step
        self._obstacles: dict[str, tuple[ObstacleState, int]] = {}
        """Name → the obstacle and its body, in the order in which they were put down."""
        self._build()

    def close(self) -> None:
        """Free the engine's memory."""
        pybullet.disconnect(self.client)

    def _build(self) -> None:
        client, profile = self.client, self._profile
        pybullet.resetSimulation(physicsClientId=client)
        pybullet.setGravity(0, 0, -GRAVITY, physicsClientId=client)
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=profile.time.physics_step,
            deterministicOverlappingPairs=1,
            restitutionVelocityThreshold=NO_BOUNCE,
            useSplitImpulse=1,  # a body pushed out of another gains no speed by it
            numSolverIterations=_ITERATIONS,
            physicsClientId=client,
        )
        self._ground = self._fixed(
            pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=client), (0, 0, 0)
        )
        self._surface(self._ground, friction=1.0, restitution=0.0)
        self._boxes = [self._box(box, 0.5, _WALL_RESTITUTION) for box in boundary(profile.field)]
        for goal in goals(profile.field):
            self._boxes += [self._box(box, 0.5, 1.0) for box in goal.frame]
            self._boxes += [self._box(box, 0.0, _NET_RESTITUTION) for box in goal.net]
        self.robots = [self._robot(place, model) for place, model in enumerate(self._models)]
        self._robot_of = {body: place for place, body in enumerate(self.robots)}
        self.ball = self._ball()
        standing = [obstacle for obstacle, _ in self._obstacles.values()]
        self._obstacles = {obstacle.name: (obstacle, self._obstacle(obstacle)) for obstacle in standing}
        self._through: int | None = None
        self.read()

    def _fixed(self, shape: int, position: Vector, orientation: Quaternion = _NO_TURN) -> int:
        body: int = pybullet.createMultiBody(
            0, shape, basePosition=position, baseOrientation=orientation, physicsClientId=self.client
        )
        return body

    def _box(self, box: Box, friction: float, restitution: float) -> int:
        half = (box.half_x, box.half_y, box.half_z)
        shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, physicsClientId=self.client)
        body = self._fixed(shape, (box.x, box.y, box.z))
        self._surface(body, friction, restitution)
        return body

    def _surface(self, body: int, friction: float, restitution: float) -> None:
        """Bullet multiplies the coefficients of two bodies: where a body has 1, the ball's own counts."""
        pybullet.changeDynamics(
            body, -1, lateralFriction=friction, restitution=restitution, physicsClientId=self.client
        )

    def _robot(self, place: int, model: RobotModel) -> int:
        robot, client = model.body, self.client
        shape = self._hull(robot)
        aside = (3.0 * place, -1000.0, robot.height / 2)  # out of everybody's way until it is placed
        body: int = pybullet.createMultiBody(robot.mass, shape, basePosition=aside, physicsClientId=client)
        pybullet.changeDynamics(
            body,
            -1,
            localInertiaDiagonal=(robot.inertia_xx, robot.inertia_xx, robot.inertia_zz),
            linearDamping=0.0,
            angularDamping=0.0,
            physicsClientId=client,
        )
        self._surface(body, robot.friction, robot.restitution / max(self._profile.ball.restitution, 1e-9))
        pybullet.setCollisionFilterPair(body, self._ground, -1, -1, 0, physicsClientId=client)
        return body

    def _hull(self, robot: RobotBody) -> int:
        """The cylinder, and the frame flush with its front, both cut into a lower and an upper half.

        A push then meets the hull at two heights. At one, the solver lets the body tip rather than stop, and bodies
        sink into each other before they are upright again.
        """
        half, depth, width = robot.height / 2, robot.frame_depth / 2, robot.frame_width / 2
        levels = (-half / 2, half / 2)
        kinds, at = [pybullet.GEOM_CYLINDER] * 2, [(0.0, 0.0, z) for z in levels]
        if robot.frame_width:
            kinds += [pybullet.GEOM_BOX] * 2
            at += [(robot.radius - depth, 0.0, z) for z in levels]
        shape: int = pybullet.createCollisionShapeArray(
            shapeTypes=kinds,
            radii=[robot.radius] * len(kinds),
            lengths=[half] * len(kinds),
            halfExtents=[(depth, width, half / 2)] * len(kinds),
            collisionFramePositions=at,
            physicsClientId=self.client,
        )
        return shape

    def _obstacle(self, obstacle: ObstacleState) -> int:
        client, half_z = self.client, obstacle.height / 2
        if obstacle.shape is Shape.CYLINDER:
            shape = pybullet.createCollisionShape(
                pybullet.GEOM_CYLINDER, radius=obstacle.radius, height=obstacle.height, physicsClientId=client
            )
        else:
            half = (obstacle.size_x / 2, obstacle.size_y / 2, half_z)
            shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, physicsClientId=client)
        body = self._fixed(shape, (obstacle.x, obstacle.y, half_z), _upright(obstacle.heading))
        self._surface(body, friction=0.5, restitution=_WALL_RESTITUTION)
        return body

    @property
    def obstacles(self) -> tuple[ObstacleState, ...]:
        """All obstacles, in the order in which they were put down."""
        return tuple([obstacle for obstacle, _ in self._obstacles.values()])

    def put_obstacle(self, obstacle: ObstacleState) -> None:
        """Put an obstacle down, in place of one of the same name."""
        if obstacle.name in self._obstacles:
            self.remove_obstacle(obstacle.name)
        self._obstacles[obstacle.name] = obstacle, self._obstacle(obstacle)

    def remove_obstacle(self, name: str) -> None:
        """Take an obstacle away.

        Raises:
            KeyError: none is named so.
        """
        _, body = self._obstacles.pop(name)
        pybullet.removeBody(body, physicsClientId=self.client)

    def _ball(self) -> int:
        ball, client = self._profile.ball, self.client
        shape = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=ball.radius, physicsClientId=client)
        body: int = pybullet.createMultiBody(ball.mass, shape, basePosition=(0, 0, ball.radius), physicsClientId=client)
        pybullet.changeDynamics(
            body,
            -1,
            localInertiaDiagonal=(ball.inertia,) * 3,
            linearDamping=0.0,
            angularDamping=0.0,
            contactProcessingThreshold=_TOUCHES,
            rollingFriction=0.0,
            spinningFriction=0.0,
            physicsClientId=client,
        )
        self._surface(body, ball.friction, ball.restitution)
        return body

    def rebuild(self, robots: Sequence[RobotState], ball: BallState) -> None:
        """Build the world anew with these poses and velocities: robots upright, the ball without spin, held by nobody.

        Its future then depends on these numbers alone: contact caches and warm starts are gone.
        """
        self._build()
        for body, height, robot in zip(self.robots, self._heights, robots, strict=True):
            velocity, spin = (robot.vx, robot.vy, 0.0), (0.0, 0.0, robot.omega)
            self._put(body, BodyState((robot.x, robot.y, height), _upright(robot.heading), velocity, spin))
        position, velocity = (ball.x, ball.y, ball.z), (ball.vx, ball.vy, ball.vz)
        self._put(self.ball, BodyState(position, _NO_TURN, velocity, _NOTHING))
        self.read()

    def _state(self, body: int) -> BodyState:
        position, orientation = pybullet.getBasePositionAndOrientation(body, physicsClientId=self.client)
        velocity, spin = pybullet.getBaseVelocity(body, physicsClientId=self.client)
        return BodyState(position, orientation, velocity, spin)

    def _put(self, body: int, state: BodyState) -> None:
        pybullet.resetBasePositionAndOrientation(body, state.position, state.orientation, physicsClientId=self.client)
        pybullet.resetBaseVelocity(body, state.velocity, state.spin, physicsClientId=self.client)

    def place(self, placement: Placement) -> None:
        """Set a robot or the ball down, at rest or with a velocity, and take in its state."""
        if placement.body == "ball":
            height = self._profile.ball.radius if placement.z is None else placement.z
            velocity = (placement.vx, placement.vy, placement.vz)
            self._put(self.ball, BodyState((placement.x, placement.y, height), _NO_TURN, velocity, _NOTHING))
            self._states[-1] = self._state(self.ball)
            return
        place = self.names.index(placement.body)
        position = (placement.x, placement.y, self._heights[place])
        velocity, spin = (placement.vx, placement.vy, 0.0), (0.0, 0.0, placement.omega)
        self._put(self.robots[place], BodyState(position, _upright(placement.heading), velocity, spin))
        self._states[place] = self._state(self.robots[place])

    def read(self) -> None:
        """Take in the state of all bodies; a robot that was lifted or tipped is put upright first."""
        self._states = [self._state(body) for body in (*self.robots, self.ball)]
        self.robot_contacts = self._robot_contacts()
        for place, (body, height) in enumerate(zip(self.robots, self._heights, strict=True)):
            position, (qx, qy, qz, qw), velocity, spin = self._states[place]
            if abs(qx) > _UPRIGHT or abs(qy) > _UPRIGHT or abs(position[2] - height) > _UPRIGHT:
                at, moving = self._stands_at(place), (velocity[0], velocity[1], 0.0)
                self._put(body, BodyState(at, _upright(2.0 * math.atan2(qz, qw)), moving, (0.0, 0.0, spin[2])))
                self._states[place] = self._state(body)

    def _stands_at(self, place: int) -> Vector:
        """The centre of a tipped robot once it is upright: where it is, or as the ball sees it if it can be its doing.

        A pressed ball is light and touches a hull at its foot, or in the air near its top, so the solver tips the
        robot rather than stops it. Put upright about its centre, the robot would come down into the ball.
        """
        (x, y, _), (qx, qy, qz, qw), *_ = self._states[place]
        (ball_x, ball_y, ball_z), height = self._states[-1].position, self._heights[place]
        if math.hypot(ball_x - x, ball_y - y) < self._models[place].body.reach + 2.0 * self._profile.ball.radius:
            below = height - min(ball_z, 2.0 * height)
            x, y = x - below * 2.0 * (qx * qz + qw * qy), y - below * 2.0 * (qy * qz - qw * qx)
        return x, y, height

    def robot_states(self, holding: int | None) -> tuple[RobotState, ...]:
        """All robots, as they were read."""
        return tuple(_robot_state(state, place == holding) for place, state in enumerate(self._states[:-1]))

    def ball_state(self) -> BallState:
        """The ball, as it was read."""
        position, _, velocity, _ = self._states[-1]
        return BallState(*position, *velocity)

    def ball_spin(self) -> tuple[float, float]:
        """The ball's spin about x and y in rad/s, as it was read."""
        return self._states[-1].spin[:2]

    def packed(self) -> bytes:
        """What was read, robots, ball and obstacles, as little-endian doubles: equal bytes, equal worlds."""
        bodies = [_STATE.pack(*p, *o, *v, *s) for p, o, v, s in self._states]
        return b"".join(bodies + [_pack(obstacle) for obstacle, _ in self._obstacles.values()])

    def robot_now(self, place: int) -> RobotState:
        """One robot between two steps."""
        return _robot_state(self._state(self.robots[place]), True)

    def ball_now(self) -> BodyState:
        """The ball between two steps."""
        return self._state(self.ball)

    def drive(self, velocities: Sequence[tuple[float, float, float]]) -> None:
        """Set every robot's velocity in the field frame, (vx, vy, omega), for the next step."""
        lift, client, reset = self._lift, self.client, pybullet.resetBaseVelocity
        for body, (vx, vy, omega) in zip(self.robots, velocities, strict=True):
            reset(body, (vx, vy, lift), (0.0, 0.0, omega), physicsClientId=client)

    def bring_together(
        self,
        robots: Sequence[tuple[int, int]],
        fixed: Sequence[tuple[int, int]],
        velocities: Sequence[tuple[float, float, float]],
    ) -> None:
        """Move robots that would sink into another body in the next step to where they touch it.

        The engine knows of a contact only at the beginning of a step: of two robots that meet at 8 m/s, 4 cm too
        late. `robots` are pairs of them, `fixed` robots and bodies of the pitch, its boxes first, then the obstacles;
        `velocities` as `drive` will set them.
        """
        for one, other in robots:
            time = self._time_to_touch(self.robots[one], self.robots[other], velocities[one], velocities[other])
            if time > 0.0:
                self._move_on(one, velocities[one], time)
                self._move_on(other, velocities[other], time)
        if not fixed:
            return
        bodies = self._boxes + [body for _, body in self._obstacles.values()]
        for one, other in fixed:
            time = self._time_to_touch(self.robots[one], bodies[other], velocities[one], _NOTHING)
            if time > 0.0:
                self._move_on(one, velocities[one], time)

    def _time_to_touch(self, one: int, other: int, velocity: Vector, others: Vector) -> float:
        """s after which two bodies touch, if the next step would bring them deep into each other; else 0."""
        client, step = self.client, self._profile.time.physics_step
        near = pybullet.getClosestPoints(one, other, step * _TOP_SPEED, physicsClientId=client)
        if not near:
            return 0.0
        point = min(near, key=_distance_of)
        normal, gap = point[7], point[8]
        closing = 0.0
        for body, at, (vx, vy, omega), sign in ((one, point[5], velocity, -1.0), (other, point[6], others, 1.0)):
            (x, y, _), _ = pybullet.getBasePositionAndOrientation(body, physicsClientId=client)
            closing += sign * (normal[0] * (vx - omega * (at[1] - y)) + normal[1] * (vy + omega * (at[0] - x)))
        if gap <= 0.0 or closing * step < gap + DEEP:
            return 0.0
        time: float = (gap + _BROUGHT_TO) / closing
        return time

    def _move_on(self, place: int, velocity: Vector, time: float) -> None:
        """Move a robot on by `time` s; its velocity is to be set after this."""
        (x, y, z), (_, _, qz, qw), _, _ = self._state(self.robots[place])
        vx, vy, omega = velocity
        turned = 2.0 * math.atan2(qz, qw) + omega * time
        at = (x + vx * time, y + vy * time, z)
        pybullet.resetBasePositionAndOrientation(self.robots[place], at, _upright(turned), physicsClientId=self.client)

    def bring_ball(self, ball: BodyState) -> None:
        """Move a fast ball, in this state, to where it touches a body that it would sink into in the next step.

        As with robots, the engine would notice too late: at 20 m/s, 10 cm. What is deep in a hull is pushed out again
        besides bouncing off, so that the rebound would depend on chance.
        """
        position, _, velocity, spin = ball
        if math.hypot(*velocity) < self._fast:
            return
        way = [speed * self._profile.time.physics_step for speed in velocity]
        room = self._profile.ball.radius + _STIRS
        low = [at + min(0.0, by) - room for at, by in zip(position, way, strict=True)]
        high = [at + max(0.0, by) + room for at, by in zip(position, way, strict=True)]
        near = pybullet.getOverlappingObjects(low, high, physicsClientId=self.client) or ()
        passes = {self.ball, self._ground, None if self._through is None else self.robots[self._through]}
        bodies = sorted({body for body, _ in near} - passes)
        left = self._profile.time.physics_step
        for _ in range(_APPROACHES):
            times = [self._ball_time_to(body, velocity, left) for body in bodies]
            ahead = min((time for time in times if time is not None), default=None)
            if ahead is None:  # it passes by
                if left < self._profile.time.physics_step:
                    self._put(self.ball, BodyState(position, _NO_TURN, velocity, spin))
                return
            if ahead == 0.0:
                return
            left -= ahead
            spent = self._profile.time.physics_step - left
            x, y, z = (at + speed * spent for at, speed in zip(position, velocity, strict=True))
            self._put(self.ball, BodyState((x, y, z), _NO_TURN, velocity, spin))

    def _ball_time_to(self, body: int, velocity: Vector, left: float) -> float | None:
        """s after which the ball may touch a body, 0 if it does already; nothing if not in the `left` s of a step.

        Between round bodies it touches later, never earlier.
        """
        near = pybullet.getClosestPoints(self.ball, body, left * _TOP_SPEED, physicsClientId=self.client)
        if not near:
            return None
        point = min(near, key=_distance_of)
        (nx, ny, nz), gap = point[7], point[8]
        (x, y, _), _ = pybullet.getBasePositionAndOrientation(body, physicsClientId=self.client)
        (vx, vy, vz), (_, _, omega) = pybullet.getBaseVelocity(body, physicsClientId=self.client)
        at_x, at_y, _ = point[6]
        vx, vy = vx - omega * (at_y - y), vy + omega * (at_x - x)
        closing = nx * (vx - velocity[0]) + ny * (vy - velocity[1]) + nz * (vz - velocity[2])
        if closing * left <= gap + _BROUGHT_TO:
            return None
        return 0.0 if gap <= 0.0 else (gap + _BROUGHT_TO) / closing

    def move_ball(self, velocity: Vector, spin: Vector) -> None:
        """Set the ball's velocity and spin."""
        pybullet.resetBaseVelocity(self.ball, velocity, spin, physicsClientId=self.client)

    def set_ball(self, position: Vector, velocity: Vector, spin: Vector) -> None:
        """Set the ball's place, velocity and spin."""
        self._put(self.ball, BodyState(position, _NO_TURN, velocity, spin))

    def push_ball(self, force: Vector, at: Vector) -> None:
        """Apply a force, N, to the ball's centre `at` for the next step."""
        pybullet.applyExternalForce(self.ball, -1, force, at, pybullet.WORLD_FRAME, physicsClientId=self.client)

    def let_through(self, robot: int | None) -> None:
        """Let the ball not collide with this one robot, or collide with all: a held ball lies a little in the hull."""
        if robot == self._through:
            return
        for place, collide in ((self._through, 1), (robot, 0)):
            if place is not None:
                pybullet.setCollisionFilterPair(
                    self.robots[place], self.ball, -1, -1, collide, physicsClientId=self.client
                )
        self._through = robot

    def step(self) -> None:
        """One physics step."""
        pybullet.stepSimulation(physicsClientId=self.client)

    def ball_contacts(self, holder: int | None) -> "BallContacts":
        """What the ball touched in the last step, beside the ground; against its holder it is never pressed."""
        contacts = pybullet.getContactPoints(self.ball, physicsClientId=self.client)
        if len(contacts) < 2 and (not contacts or contacts[0][2] == self._ground):
            return _NO_CONTACTS
        depth = {contact[2]: -contact[8] for contact in contacts if contact[2] != self._ground}
        robots = [place for place, body in enumerate(self.robots) if body in depth]
        if holder is not None:
            depth.pop(self.robots[holder], None)
        return BallContacts(robots, max(depth.values(), default=0.0))

    def _robot_contacts(self) -> tuple[tuple[int, int], ...]:
        """Pairs of robots that touched each other in the last step, in roster order."""
        bodies = self._robot_of
        found = [
            (bodies[contact[1]], bodies[contact[2]])
            for contact in pybullet.getContactPoints(physicsClientId=self.client)
            if contact[8] <= _TOUCHING and contact[1] in bodies and contact[2] in bodies
        ]
        return tuple(sorted({(min(pair), max(pair)) for pair in found})) if found else ()


def _upright(heading: float) -> Quaternion:
    return (0.0, 0.0, math.sin(heading / 2.0), math.cos(heading / 2.0))


def _pack(obstacle: ObstacleState) -> bytes:
    o = obstacle
    return o.name.encode() + _OBSTACLE.pack(o.x, o.y, o.heading, o.radius, o.height, o.size_x, o.size_y)


def _robot_state(state: BodyState, holding: bool) -> RobotState:
    (x, y, z), (_, _, qz, qw), (vx, vy, _), (_, _, omega) = state
    return RobotState(x, y, z, wrap(2.0 * math.atan2(qz, qw)), vx, vy, omega, holding)


def _distance_of(point: tuple[Any, ...]) -> float:
    distance: float = point[8]
    return distance


class BallContacts(NamedTuple):
    """Robots that touch the ball, in roster order, and how deep it is pressed into others than ground and holder, m."""

    robots: list[int]
    depth: float


_NO_CONTACTS = BallContacts([], 0.0)


def fingerprint() -> dict[str, str]:
    """What two machines must share to compute the same world: the engine, and the maths library's answers."""
    answers = (math.sin(1e5), math.cos(2.5), math.exp(1.1), math.atan2(0.3, -0.7), math.pow(1.1, 7.3), math.log(3.3))
    version = importlib.metadata.version("pybullet")
    return {"engine": f"pybullet {version}, api {pybullet.getAPIVersion()}", "libm": struct.pack("<6d", *answers).hex()}
