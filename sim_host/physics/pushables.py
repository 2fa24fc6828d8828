"""Obstacles that can be pushed: friction on the ground, and an upright body.

As robots do, they do not collide with the ground in the engine, which would cost contacts in each step. Friction acts
on place and turning together (Howe and Cutkosky 1996, the ellipsoid of a limit surface): it takes μ·g of the speed
(vx, vy, k·omega), where k is the radius of gyration.
"""

import math

from schemas.config.rolling import GRAVITY
from schemas.frames import wrap
from sim_host.physics.bodies import upright
from sim_host.physics.body_state import BodyState
from sim_host.physics.bullet import pybullet
from sim_host.physics.vectors import FieldTwist
from sim_host.snapshot import ObstacleState, Pushed


class Pushable:
    """One obstacle that can be pushed, between two steps."""

    def __init__(self, client: int, body: int, obstacle: ObstacleState, pushed: Pushed, step_s: float) -> None:
        """`obstacle` is where it begins, and `body` its number in the engine."""
        self.body = body
        self.obstacle = obstacle
        """Its place and velocity, as last read."""
        self._client = client
        self._pushed = pushed
        self._lift = GRAVITY * step_s
        self._lost = pushed.friction * self._lift
        """m/s that friction takes in a step."""
        self._gyration = _gyration(obstacle)

    def set(self, x: float, y: float, heading: float, twist: FieldTwist) -> None:
        """Put it upright at a pose in the field frame, with a velocity."""
        at, (vx, vy, omega) = (x, y, self.obstacle.height / 2), twist
        pybullet.resetBasePositionAndOrientation(self.body, at, upright(heading), physicsClientId=self._client)
        pybullet.resetBaseVelocity(self.body, (vx, vy, 0.0), (0.0, 0.0, omega), physicsClientId=self._client)
        pushed = self._pushed._replace(vx=vx, vy=vy, omega=omega)
        self.obstacle = self.obstacle._replace(x=x, y=y, heading=heading, pushed=pushed)

    def continue_from(self, obstacle: ObstacleState) -> None:
        """Take over the pose and the velocity of an obstacle of the same name."""
        pushed = obstacle.pushed
        twist = (0.0, 0.0, 0.0) if pushed is None else (pushed.vx, pushed.vy, pushed.omega)
        self.set(obstacle.x, obstacle.y, obstacle.heading, twist)

    def twist(self) -> FieldTwist:
        """Its velocity, from the engine."""
        (vx, vy, _), (_, _, omega) = pybullet.getBaseVelocity(self.body, physicsClientId=self._client)
        return vx, vy, omega

    def brake(self) -> None:
        """Let friction act for the next step."""
        vx, vy, omega = self.twist()
        speed = math.hypot(vx, vy, self._gyration * omega)
        kept = 1.0 - self._lost / speed if speed > self._lost else 0.0
        velocity, spin = (kept * vx, kept * vy, self._lift), (0.0, 0.0, kept * omega)
        pybullet.resetBaseVelocity(self.body, velocity, spin, physicsClientId=self._client)

    def read(self) -> None:
        """Read its state, and put it upright: what contacts have tipped or lifted does not stay so."""
        position, orientation = pybullet.getBasePositionAndOrientation(self.body, physicsClientId=self._client)
        heading = wrap(2.0 * math.atan2(orientation[2], orientation[3]))
        self.set(position[0], position[1], heading, self.twist())

    def state(self) -> BodyState:
        """Its state, as last read."""
        at, (vx, vy, omega, *_) = self.obstacle, self.obstacle.pushed or self._pushed
        centre = (at.x, at.y, at.height / 2)
        return BodyState(centre, upright(at.heading), (vx, vy, 0.0), (0.0, 0.0, omega))


def inertia(obstacle: ObstacleState, mass: float) -> tuple[float, float, float]:
    """Moments of inertia of a solid body about its centre, in kg·m²."""
    long, wide, high = obstacle.size_x, obstacle.size_y, obstacle.height
    if obstacle.is_round:
        across = mass * (3.0 * (long / 2) ** 2 + high**2) / 12.0
        return across, across, mass * (long / 2) ** 2 / 2.0
    return mass * (wide**2 + high**2) / 12.0, mass * (long**2 + high**2) / 12.0, mass * (long**2 + wide**2) / 12.0


def _gyration(obstacle: ObstacleState) -> float:
    """Radius of gyration about the vertical axis in m."""
    return math.sqrt(inertia(obstacle, 1.0)[2])
