"""Continuous collision: moves bodies that hit each other to where they touch, before the engine steps.

The engine finds contacts at the beginning of a step only. Two robots that meet at 8 m/s would overlap by 4 cm before
it does, and a ball of 20 m/s would be 10 cm inside a hull. A body that deep is pushed out as well as bounced off. A gap
that two robots would close within the step is worse: the engine takes what closes it from the rebound, which then
depends on where in a step they meet, from none of the approach to a third of it.
"""

import math
from collections.abc import Mapping, Sequence

from schemas.config.profile import Profile
from sim_host.physics.bodies import upright
from sim_host.physics.body_state import BodyState
from sim_host.physics.collision_candidates import MIN_IMPACT, IndexPairs
from sim_host.physics.engine import Engine
from sim_host.physics.vectors import FieldTwist, Vector

_CONTACT_DEPTH = 0.001
"""m by which bodies overlap after they were moved together: enough for the engine to find the contact."""
_MAX_MOTION = 0.03
"""m that a robot may move in a step."""
_ROUNDS = 6
"""Iterations of the approach: the nearest points of bodies that turn, or meet off their axes, change on the way."""
_TOP_SPEED = 60.0
"""m/s; no two bodies approach faster: twice the highest speed of a drive, and the turning of their frames."""

_AT_REST: FieldTwist = (0.0, 0.0, 0.0)


class ContinuousCollision:
    """Moves bodies forward within the next step; their velocities do not change."""

    def __init__(self, profile: Profile, engine: Engine) -> None:
        self._engine = engine
        self._step = profile.time.physics_step
        self._radius = profile.ball.radius
        self._early = 1.0 + min(engine.restitution, 1.0)
        """Steps; the engine stops bodies that would meet within these: the rebound counts against the gap."""

    def advance_robots(self, robots: IndexPairs, fixed: IndexPairs, twists: Sequence[FieldTwist]) -> None:
        """Move robots that would meet another body in the next step to where they touch it.

        `robots` are pairs of robots. `fixed` are pairs of a robot and another body: first the boxes of the pitch, then
        the obstacles. `twists` are the velocities of the robots in the next step.
        """
        bodies, fixed_bodies = self._engine.robots, self._engine.fixed_bodies() if fixed else []
        pushed = self._engine.pushed_twists() if fixed else {}
        for one, other in robots:
            self._advance_pair({bodies[one]: twists[one], bodies[other]: twists[other]})
        for one, other in fixed:
            body = fixed_bodies[other]
            self._advance_pair({bodies[one]: twists[one], body: pushed.get(body, _AT_REST)})

    def _advance_pair(self, twists: Mapping[int, FieldTwist]) -> None:
        """Move two bodies with these velocities to where they touch, if the engine would stop them in the next step."""
        (one, twist), (other, other_twist) = twists.items()
        for _ in range(_ROUNDS):
            time = self._time_to_touch(one, other, twist, other_twist)
            if time == 0.0:
                return
            for body, moving in twists.items():
                if any(moving):
                    self._move_forward(body, moving, time)

    def _time_to_touch(self, one: int, other: int, twist: FieldTwist, other_twist: FieldTwist) -> float:
        """s after which two bodies touch, if the engine would stop them in the next step; otherwise 0."""
        gap = self._engine.gap(one, other, self._step * _TOP_SPEED)
        if gap is None or gap.width <= 0.0:
            return 0.0
        closing = 0.0
        for body, at, (vx, vy, omega), sign in (
            (one, gap.on_one, twist, -1.0),
            (other, gap.on_other, other_twist, 1.0),
        ):
            x, y, _ = self._engine.state(body).position
            closing += sign * (gap.normal[0] * (vx - omega * (at[1] - y)) + gap.normal[1] * (vy + omega * (at[0] - x)))
        if closing < MIN_IMPACT or closing * self._step * self._early < gap.width:
            return 0.0
        return (gap.width + _CONTACT_DEPTH) / closing

    def _move_forward(self, body: int, twist: FieldTwist, time: float) -> None:
        """Move a robot forward by `time` s."""
        now = self._engine.state(body)
        (x, y, z), (_, _, qz, qw), (vx, vy, omega) = now.position, now.orientation, twist
        turned = 2.0 * math.atan2(qz, qw) + omega * time
        self._engine.set_state(
            body, now._replace(position=(x + vx * time, y + vy * time, z), orientation=upright(turned))
        )

    def advance_ball(self, ball: BodyState) -> None:
        """Move a ball with this state, unless it is slow, to where it touches a body that it hits in the next step."""
        position, _, velocity, spin = ball
        if math.hypot(*velocity) < MIN_IMPACT:
            return
        step, room = self._step, self._radius + _MAX_MOTION
        (x, y, z), (vx, vy, vz) = position, velocity
        low = x + min(0.0, vx * step) - room, y + min(0.0, vy * step) - room, z + min(0.0, vz * step) - room
        high = x + max(0.0, vx * step) + room, y + max(0.0, vy * step) + room, z + max(0.0, vz * step) + room
        bodies = self._engine.bodies_near_ball(low, high)
        if not bodies:
            return
        left = step
        for _ in range(_ROUNDS):
            times = [self._ball_time_to(body, velocity, left) for body in bodies]
            ahead = min((time for time in times if time is not None), default=None)
            if ahead is None:  # it passes by
                if left < step:
                    self._engine.set_ball_state(position, velocity, spin)
                return
            if ahead == 0.0:
                return
            left -= ahead
            spent = step - left
            self._engine.set_ball_state((x + vx * spent, y + vy * spent, z + vz * spent), velocity, spin)

    def _ball_time_to(self, body: int, velocity: Vector, left: float) -> float | None:
        """s after which the ball may touch a body, 0 if it touches already, None if not in the `left` s of a step.

        For round bodies this is a lower bound: they touch no earlier.
        """
        gap = self._engine.gap(self._engine.ball, body, left * _TOP_SPEED)
        if gap is None:
            return None
        (x, y, _), _, (vx, vy, vz), (_, _, omega) = self._engine.state(body)
        (nx, ny, nz), (at_x, at_y, _) = gap.normal, gap.on_other
        vx, vy = vx - omega * (at_y - y), vy + omega * (at_x - x)
        closing = nx * (vx - velocity[0]) + ny * (vy - velocity[1]) + nz * (vz - velocity[2])
        if closing * left <= gap.width + _CONTACT_DEPTH:
            return None
        return 0.0 if gap.width <= 0.0 else (gap.width + _CONTACT_DEPTH) / closing
