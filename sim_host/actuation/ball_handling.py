"""What robots and ground do to the ball: it is held, carried, kicked, or rolls freely."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from schemas.host import AppliedInput
from schemas.profile import Dribble, Profile
from schemas.robot_model import RobotModel
from sim_host.actuation.drive import FieldDrive
from sim_host.actuation.kick import KickRefusedError, launch
from sim_host.actuation.possession import can_hold, holder
from sim_host.snapshot import BallState, RobotState
from sim_host.world.engine import BallContacts, Engine

_ON_GROUND = 0.01
"""m; a ball with more air below it does not roll."""
_RISING = 0.2
"""m/s; a ball that is launched faster than this is off the ground before it could roll."""
_PULL = 2.0
"""m/s; how fast a held ball is drawn to its place before the robot, beside moving along with it."""
_PRESSED = 0.01
"""m; a held ball that is pressed this deep into another body is lost: it is never carried through one."""


@dataclass(slots=True)
class BallReport:
    """What happened to the ball in one tick; robots by their place in the roster."""

    refused: dict[int, str] = field(default_factory=dict)
    """Kicks that could not be done, and why."""
    touches: list[int] = field(default_factory=list)
    kicked: int | None = None


class BallHandling:
    """Possession and motion of the ball."""

    def __init__(self, profile: Profile, models: Sequence[RobotModel], engine: Engine) -> None:
        self._profile = profile
        self._models = models
        self._dribbles = [model.dribble for model in models]
        self._engine = engine
        self._step = profile.time.physics_step
        self._rolling_mass = profile.ball.mass + profile.ball.inertia / profile.ball.radius**2
        self.holding: int | None = None
        self._leaving: int | None = None
        """The robot whose kicked ball has not left its hull yet."""

    def hold(self, place: int | None) -> None:
        """Make a robot the holder, or nobody."""
        self._engine.let_through(place)
        self.holding = place
        self._leaving = None

    def begin(self, robots: tuple[RobotState, ...], ball: BallState, inputs: Sequence[AppliedInput]) -> BallReport:
        """Decide possession and carry out kicks, at the beginning of a tick.

        Robots that dribble claim the ball, and those that kick. A kick is done now or refused now; none is kept.
        """
        report = BallReport()
        claims = [place for place, one in enumerate(inputs) if one.dribble or one.kick is not None]
        new = holder(claims, robots, ball, self._dribbles) if claims else None
        if new != self.holding:
            self.hold(new)
        for place in claims:
            kick = inputs[place].kick
            if kick is None:
                continue
            if place != self.holding:
                report.refused[place] = "kick: ball not held"
                continue
            try:
                self._launch(launch(kick, ball.x, robots[place].heading, self._models[place].kicker, self._profile))
            except KickRefusedError as refusal:
                report.refused[place] = str(refusal)
                continue
            report.kicked = place
            report.touches.append(place)
        if report.kicked is not None:
            self.holding, self._leaving = None, report.kicked
        return report

    def before_step(self, drives: Sequence[FieldDrive]) -> None:
        """Move the ball as its holder does, or let the ground slow it."""
        if self.holding is not None:
            self._carry(self._engine.robot_now(self.holding), drives[self.holding], self._dribbles[self.holding])
        else:
            self._roll(self._engine.ball_now())

    def after_step(self, report: BallReport) -> None:
        """Note who touched the ball."""
        contacts: BallContacts = self._engine.ball_contacts()
        if self._leaving is not None:
            self._leave(self._leaving)
        if self.holding is not None:
            report.touches.append(self.holding)
            if contacts.depth > _PRESSED:
                self.hold(None)
        report.touches.extend(contacts.robots)

    def let_go(self, robots: tuple[RobotState, ...], ball: BallState) -> bool:
        """At the end of a tick, let a ball go that has left its holder; whether one was."""
        if self.holding is None or can_hold(robots[self.holding], ball, self._dribbles[self.holding]):
            return False
        self.hold(None)
        return True

    def _leave(self, kicker: int) -> None:
        """Let a kicked ball collide with its kicker again as soon as it has left the hull."""
        robot, ball, hull = self._engine.robot_now(kicker), self._engine.ball_now(), self._models[kicker].body
        touching = hull.radius + self._profile.ball.radius
        if math.hypot(ball.x - robot.x, ball.y - robot.y) > touching or ball.z > hull.height:
            self.hold(None)

    def _launch(self, velocity: tuple[float, float, float]) -> None:
        """Set the ball going; along the ground it rolls at once, so that it keeps its exit speed."""
        vx, vy, vz = velocity
        self._engine.move_ball((vx, vy, vz), self._rolling(vx, vy) if vz == 0.0 else (0.0, 0.0, 0.0))

    def _rolling(self, vx: float, vy: float) -> tuple[float, float, float]:
        """The spin of a ball that rolls at this velocity."""
        radius = self._profile.ball.radius
        return -vy / radius, vx / radius, 0.0

    def _carry(self, robot: RobotState, drive: FieldDrive, dribble: Dribble) -> None:
        """Move the ball with its holder for one step, toward the gap before it (paper, equation 2)."""
        vx, vy, omega = drive
        gap, dt = dribble.gap, self._step
        turned = robot.heading + omega * dt
        x, y = robot.x + vx * dt + gap * math.cos(turned), robot.y + vy * dt + gap * math.sin(turned)
        if dribble.method == "pose":
            at = (robot.x + gap * math.cos(robot.heading), robot.y + gap * math.sin(robot.heading))
            velocity = ((x - at[0]) / dt, (y - at[1]) / dt, 0.0)
            self._engine.set_ball((*at, self._profile.ball.radius), velocity, self._rolling(*velocity[:2]))
            return
        ball = self._engine.ball_now()
        along = (vx - omega * (ball.y - robot.y), vy + omega * (ball.x - robot.x))  # v + ω × r
        pull = ((x - ball.x) / dt - along[0], (y - ball.y) / dt - along[1])
        share = min(1.0, _PULL / max(math.hypot(*pull), 1e-9))
        carried = (along[0] + share * pull[0], along[1] + share * pull[1])
        self._engine.move_ball((*carried, ball.vz), self._rolling(*carried))

    def _roll(self, ball: BallState) -> None:
        """Rolling resistance on a ball on the ground: a force that slows rolling, and stops it at rest."""
        if ball.z > self._profile.ball.radius + _ON_GROUND or ball.vz > _RISING:
            return
        speed = math.hypot(ball.vx, ball.vy)
        in_net = abs(ball.x) > self._profile.field.goal_line and abs(ball.y) < self._profile.field.goal_width / 2
        slowing = self._profile.ball.net_deceleration if in_net else self._profile.ball.rolling_deceleration
        if speed <= slowing * self._step:
            if speed > 0.0:
                self._engine.move_ball((0.0, 0.0, ball.vz), (0.0, 0.0, 0.0))
            return
        force = -self._rolling_mass * slowing / speed
        self._engine.push_ball((force * ball.vx, force * ball.vy, 0.0), (ball.x, ball.y, ball.z))
