"""The bodies of a world: shape, mass and surface of each in PyBullet.

Robots are upright cylinders, some with a frame across their front. A ground contact cannot model their wheels, so the
engine does not collide them with the ground: their weight is compensated, and their drive is set as a velocity. They
collide with each other, the ball, the goals, the boundary and the obstacles.
"""

import math
from collections.abc import Iterator

from schemas.config.obstacle import Shape
from schemas.config.profile import Profile
from schemas.config.robot_model import RobotModel
from schemas.config.sections import RobotBody
from sim_host.physics.bullet import pybullet
from sim_host.physics.pitch import Box, boundary, goals
from sim_host.physics.vectors import Quaternion, Vector
from sim_host.snapshot import ObstacleState

_WALL_RESTITUTION = 0.5
_NET_RESTITUTION = 0.0
"""A net takes all speed that the ball has against it, and gives it no spin."""
_CONTACT_DISTANCE = 1e-3
"""m; the ball is in contact from this gap on. Bullet's default brakes it 2 cm earlier, which spoils its bounce."""

NO_TURN: Quaternion = (0.0, 0.0, 0.0, 1.0)


def upright(heading: float) -> Quaternion:
    """The orientation of an upright body that faces `heading`, rad."""
    return (0.0, 0.0, math.sin(heading / 2.0), math.cos(heading / 2.0))


def surface_restitution(robot: RobotBody, profile: Profile) -> float:
    """The restitution of a robot's surface: times the ball's own, it is the share that a ball keeps of its speed."""
    return robot.restitution / max(profile.ball.restitution, 1e-9)


class BodyMaker:
    """Makes the bodies of one world; each method returns the number that PyBullet gives to the body."""

    def __init__(self, client: int, profile: Profile) -> None:
        self._client = client
        self._profile = profile

    def ground(self) -> int:
        """The plane of the ground."""
        body = self._fixed(pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=self._client), (0, 0, 0))
        self._surface(body, friction=1.0, restitution=0.0)
        return body

    def pitch(self, *, with_goals: bool) -> Iterator[int]:
        """The boxes of the pitch, in the order of `sim_host.physics.pitch.fixed_boxes`."""
        for box in boundary(self._profile.field):
            yield self._box(box, 0.5, _WALL_RESTITUTION)
        for goal in goals(self._profile.field) if with_goals else ():
            for box in goal.frame:
                yield self._box(box, 0.5, 1.0)
            for box in goal.net:
                yield self._box(box, 0.0, _NET_RESTITUTION)

    def robot(self, place: int, model: RobotModel, ground: int) -> int:
        """A robot, far from the pitch until it is placed."""
        robot, client = model.body, self._client
        shape = self._hull(robot)
        aside = (3.0 * place, -1000.0, robot.height / 2)
        body: int = pybullet.createMultiBody(robot.mass, shape, basePosition=aside, physicsClientId=client)
        pybullet.changeDynamics(
            body,
            -1,
            localInertiaDiagonal=(robot.inertia_xx, robot.inertia_xx, robot.inertia_zz),
            linearDamping=0.0,
            angularDamping=0.0,
            physicsClientId=client,
        )
        self._surface(body, robot.friction, surface_restitution(robot, self._profile))
        pybullet.setCollisionFilterPair(body, ground, -1, -1, 0, physicsClientId=client)
        return body

    def obstacle(self, obstacle: ObstacleState) -> int:
        """An obstacle that stands fast, at its place."""
        client, half_z = self._client, obstacle.height / 2
        if obstacle.shape is Shape.CYLINDER:
            shape = pybullet.createCollisionShape(
                pybullet.GEOM_CYLINDER, radius=obstacle.radius, height=obstacle.height, physicsClientId=client
            )
        else:
            half = (obstacle.size_x / 2, obstacle.size_y / 2, half_z)
            shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, physicsClientId=client)
        body = self._fixed(shape, (obstacle.x, obstacle.y, half_z), upright(obstacle.heading))
        self._surface(body, friction=0.5, restitution=_WALL_RESTITUTION)
        return body

    def pushable(self, obstacle: ObstacleState, mass: float, inertia: Vector, ground: int) -> int:
        """An obstacle of this `mass` in kg and moments of `inertia` in kg·m², at its place.

        Like a robot's hull it has two halves, one on the other.
        """
        client, half = self._client, obstacle.height / 2
        kind = pybullet.GEOM_CYLINDER if obstacle.is_round else pybullet.GEOM_BOX
        shape = pybullet.createCollisionShapeArray(
            shapeTypes=[kind] * 2,
            radii=[obstacle.size_x / 2] * 2,
            lengths=[half] * 2,
            halfExtents=[(obstacle.size_x / 2, obstacle.size_y / 2, half / 2)] * 2,
            collisionFramePositions=[(0.0, 0.0, -half / 2), (0.0, 0.0, half / 2)],
            physicsClientId=client,
        )
        at, turned = (obstacle.x, obstacle.y, half), upright(obstacle.heading)
        body: int = pybullet.createMultiBody(
            mass, shape, basePosition=at, baseOrientation=turned, physicsClientId=client
        )
        pybullet.changeDynamics(
            body, -1, localInertiaDiagonal=inertia, linearDamping=0.0, angularDamping=0.0, physicsClientId=client
        )
        self._surface(body, friction=0.5, restitution=0.0)
        pybullet.setCollisionFilterPair(body, ground, -1, -1, 0, physicsClientId=client)
        return body

    def ball(self) -> int:
        """The ball, at rest on the centre mark."""
        ball, client = self._profile.ball, self._client
        shape = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=ball.radius, physicsClientId=client)
        body: int = pybullet.createMultiBody(ball.mass, shape, basePosition=(0, 0, ball.radius), physicsClientId=client)
        pybullet.changeDynamics(
            body,
            -1,
            localInertiaDiagonal=(ball.inertia,) * 3,
            linearDamping=0.0,
            angularDamping=0.0,
            contactProcessingThreshold=_CONTACT_DISTANCE,
            rollingFriction=0.0,
            spinningFriction=0.0,
            physicsClientId=client,
        )
        self._surface(body, ball.friction, ball.restitution)
        return body

    def _hull(self, robot: RobotBody) -> int:
        """The cylinder, and the frame flush with its front, both cut into a lower and an upper half.

        A push then acts on the hull at two heights. With one, the solver tips the body rather than stops it, and bodies
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
            physicsClientId=self._client,
        )
        return shape

    def _fixed(self, shape: int, position: Vector, orientation: Quaternion = NO_TURN) -> int:
        """A body that stands fast, and no mechanism without joints, which PyBullet makes otherwise: that costs time."""
        body: int = pybullet.createMultiBody(
            0, shape, -1, position, orientation, useMaximalCoordinates=1, physicsClientId=self._client
        )
        return body

    def _box(self, box: Box, friction: float, restitution: float) -> int:
        half = (box.half_x, box.half_y, box.half_z)
        shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half, physicsClientId=self._client)
        body = self._fixed(shape, (box.x, box.y, box.z))
        self._surface(body, friction, restitution)
        return body

    def _surface(self, body: int, friction: float, restitution: float) -> None:
        """Set friction and restitution. Bullet multiplies those of two bodies: against 1, the ball's own apply."""
        pybullet.changeDynamics(
            body, -1, lateralFriction=friction, restitution=restitution, physicsClientId=self._client
        )
