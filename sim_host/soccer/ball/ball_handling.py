"""The ball over one tick: possession, kicks, and its motion in each physics step."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from schemas.config.profile import Profile
from schemas.config.robot_model import RobotModel
from schemas.messages.applied import AppliedInput
from sim_host.game.ball_control import BallReport
from sim_host.physics.body_state import BallContacts, BodyState
from sim_host.physics.vectors import FieldTwist, Vector
from sim_host.snapshot import BallState, RobotState
from sim_host.soccer.ball.carrying import METHODS, HeldBall
from sim_host.soccer.ball.free_ball import FreeBall
from sim_host.soccer.ball.kick import KickRefusedError, Launch, PlannedKick, launch
from sim_host.soccer.ball.kickers import Kickers
from sim_host.soccer.ball.possession import can_hold, claimants, holder, why_not_held
from sim_host.soccer.ball.touches import StepTouches, by_force

if TYPE_CHECKING:  # a command that checks a match file runs without PyBullet
    from sim_host.physics.engine import Engine

_MAX_PRESSED_DEPTH = 0.005
"""m; a held ball that is pressed this deep into another body is released: it is never carried through one."""
_MAX_OVERRUN = 0.01
"""m; a ball this much nearer than the gap is inside the hull of its holder or kicker, and collides with it again."""


class BallHandling:
    """Possession and motion of the ball."""

    def __init__(self, profile: Profile, models: Sequence[RobotModel], engine: "Engine") -> None:
        self._profile = profile
        self._models = models
        self._dribbles = [model.dribble for model in models]
        self._contests = [one.method == "force" and one.contest == "all" for one in self._dribbles]
        self._engine = engine
        self._step = profile.time.physics_step
        self._free = FreeBall(profile.ball, profile.field, self._step)
        self._kickers = Kickers([model.kicker for model in models], profile.time.tick)
        self._tie = profile.ball.touch_tie
        self.holder: int | None = None
        self._contestants: list[int] = []
        """Robots other than the holder that draw the ball to themselves in this tick."""
        self._ball_leaving: int | None = None
        """The robot whose kicked ball has not left its hull yet."""

    def set_holder(self, index: int | None) -> None:
        """Make a robot the holder of the ball, or no robot.

        A ball that is carried by pose or velocity lies a little inside the hull; one drawn by forces touches it.
        """
        is_carried = index is not None and self._is_carried(index)
        self._engine.ignore_ball_contacts(index if is_carried else None)
        self.holder = index
        self._ball_leaving = None

    def reset(self, ball: BallState) -> None:
        """Make a checkpoint: no robot holds the ball, every kicker is charged, and a ball on the ground rolls."""
        self.set_holder(None)
        self._kickers.charge()
        if not self._free.is_in_air(ball.z, ball.vz):
            self._engine.set_ball_motion((ball.vx, ball.vy, ball.vz), self._free.rolling_spin(ball.vx, ball.vy))

    def kickers_ready(self, tick: int) -> tuple[bool, ...]:
        """Per robot: its kicker can kick in this tick."""
        return self._kickers.ready(tick)

    def decide_possession_and_kick(
        self, tick: int, robots: tuple[RobotState, ...], ball: BallState, inputs: Sequence[AppliedInput]
    ) -> BallReport:
        """Decide possession and carry out kicks, at the beginning of a tick.

        Robots that dribble or kick claim the ball. A kick is carried out or refused at once, and never postponed.
        """
        report = BallReport()
        claims = [index for index, one in enumerate(inputs) if one.dribble or one.kick is not None]
        able = claimants(claims, robots, ball, self._dribbles)
        new = holder(able)
        if new != self.holder:
            self.set_holder(None if new is not None and self._would_press(new) else new)
        for index in claims:
            if inputs[index].kick is None:
                continue
            try:
                self._apply_launch(index, self._kick(tick, index, robots[index], ball, inputs[index]))
            except KickRefusedError as refusal:
                report.refused[index] = str(refusal)
                continue
            self._kickers.kicked(index, tick)
            report.kicked = index
            report.touches.append(index)
        self._contestants = [] if report.kicked is not None else self._contestants_among(able)
        return report

    def _contestants_among(self, able: Sequence[tuple[float, int]]) -> list[int]:
        """The robots that draw the ball to themselves although they do not hold it, in the order of the roster."""
        return sorted(index for _, index in able if index != self.holder and self._contests[index])

    def before_step(self, drives: Sequence[FieldTwist]) -> BodyState | None:
        """Move the ball with its holder, or by ground and air; the state of a free ball, None for a held one."""
        now = self._engine.ball_now()
        position, _, velocity, spin = now
        for index in self._contestants if self.holder is None else (*self._contestants, self.holder):
            robot = self._engine.robot_now(index)
            if not self._is_overrun(index, robot, position):
                self._carry(index, robot, drives[index], BallState(*position, *velocity))
            elif index == self.holder:
                self.set_holder(None)
        if self.holder is not None:
            if not self._is_carried(self.holder):
                self._push(now)
            return None
        changed = self._free.sudden_change(position, velocity, spin)
        if changed is None:
            self._push(now)
            return now
        self._engine.set_ball_motion(*changed)
        return now._replace(velocity=changed[0], spin=changed[1])

    def _push(self, ball: BodyState) -> None:
        """Apply the forces of ground and air for this step."""
        force = self._free.force(ball.position, ball.velocity, ball.spin)
        if force != (0.0, 0.0, 0.0):
            self._engine.push_ball(force, ball.position)

    def after_step(self, report: BallReport) -> None:
        """Note the touches of this step, and release a ball that is pressed too deep."""
        contacts: BallContacts = self._engine.ball_contacts(self.holder)
        if self._ball_leaving is not None:
            self._end_kick(self._ball_leaving)
        if contacts.forces or self.holder is not None:
            _add(report, by_force(contacts.forces, self.holder, self._tie))
        if self.holder is not None and contacts.depth > _MAX_PRESSED_DEPTH:
            self.set_holder(None)

    def release_lost_ball(self, robots: tuple[RobotState, ...], ball: BallState) -> bool:
        """At the end of a tick, release a ball that has left its holder; returns whether it was released."""
        if self.holder is None or can_hold(robots[self.holder], ball, self._dribbles[self.holder]):
            return False
        self.set_holder(None)
        return True

    def _kick(self, tick: int, index: int, robot: RobotState, ball: BallState, applied: AppliedInput) -> Launch:
        """The velocity that this robot's kick gives the ball.

        Raises:
            KickRefusedError: it does not hold the ball, its kicker is not charged, or no lob is possible.
        """
        if applied.kick is None or index != self.holder:
            raise KickRefusedError(why_not_held(robot, ball, self._dribbles[index]))
        reason = self._kickers.why_not(index, tick)
        if reason is not None:
            raise KickRefusedError(reason)
        kicker = self._models[index].kicker
        return launch(applied.kick.mode, PlannedKick(applied.kick.speed, ball, robot.heading, kicker, self._profile))

    def _apply_launch(self, index: int, velocity: Launch) -> None:
        """Set the velocity of a kicked ball; along the ground it gets the kicker's share of the spin of rolling."""
        vx, vy, vz = velocity
        share = self._models[index].kicker.kick_spin if vz == 0.0 else 0.0
        self._engine.set_ball_motion((vx, vy, vz), self._free.rolling_spin(share * vx, share * vy))
        self._engine.ignore_ball_contacts(index)
        self.holder, self._ball_leaving = None, index

    def _end_kick(self, kicker: int) -> None:
        """Let a kicked ball collide with its kicker again as soon as it has left the hull."""
        robot, hull = self._engine.robot_now(kicker), self._models[kicker].body
        position, *_ = self._engine.ball_now()
        x, y, z = position
        touching = hull.reach + self._profile.ball.radius
        has_left = math.hypot(x - robot.x, y - robot.y) > touching or z > hull.height
        if has_left or self._is_overrun(kicker, robot, position):
            self.set_holder(None)

    def _would_press(self, index: int) -> bool:
        """Whether the ball is pressed into another body than the robot that would carry it.

        Carried to its place, it would be pressed deeper, released, and caught again in the next tick, deeper each time.
        """
        return self._is_carried(index) and self._engine.ball_contacts(index).depth > _MAX_PRESSED_DEPTH

    def _is_carried(self, index: int) -> bool:
        """Whether a robot carries the ball by pose or velocity, rather than draws it by forces."""
        return self._dribbles[index].method != "force"

    def _is_overrun(self, index: int, robot: RobotState, ball: Vector) -> bool:
        """Whether the ball is inside the hull of this robot, which draws it, holds it or kicked it."""
        return math.hypot(ball[0] - robot.x, ball[1] - robot.y) < self._dribbles[index].gap - _MAX_OVERRUN

    def _carry(self, index: int, robot: RobotState, drive: FieldTwist, ball: BallState) -> None:
        """Move the ball with this robot for one step."""
        dribble, engine = self._dribbles[index], self._engine
        held = HeldBall(robot, drive, ball, dribble, self._profile.ball.radius, self._step)
        at, velocity, force = METHODS[dribble.method](held)
        if velocity is not None:
            spin = self._free.rolling_spin(velocity[0], velocity[1])
            if at is not None:
                engine.set_ball_state(at, velocity, spin)
            else:
                engine.set_ball_motion(velocity, spin)
        if force is not None:
            engine.push_ball(force, (ball.x, ball.y, ball.z))


def _add(report: BallReport, step: StepTouches) -> None:
    """Add the touches of a step after the earlier ones."""
    if step.robots:
        report.touches += step.robots
        report.level = step.level
