"""The ball over one tick: who holds it, who kicks it, and what moves it in each physics step."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from schemas.host import AppliedInput
from schemas.profile import Profile
from schemas.robot_model import RobotModel
from sim_host.actuation.air import Vector
from sim_host.actuation.carrying import WAYS, Hold
from sim_host.actuation.drive import FieldDrive
from sim_host.actuation.free_ball import FreeBall
from sim_host.actuation.kick import KickRefusedError, Launch, Shot, launch
from sim_host.actuation.kickers import Kickers
from sim_host.actuation.possession import can_hold, holder, why_not_held
from sim_host.snapshot import BallState, RobotState
from sim_host.world.engine import BallContacts, BodyState, Engine

_PRESSED = 0.005
"""m; a held ball that is pressed this deep into another body is lost: it is never carried through one."""
_OVERRUN = 0.01
"""m; a ball this much nearer than the gap is in the hull of its holder or kicker, who pushes it from then on."""


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
        self._free = FreeBall(profile.ball, profile.field, self._step)
        self._kickers = Kickers([model.kicker for model in models], profile.time.tick)
        self.holding: int | None = None
        self._leaving: int | None = None
        """The robot whose kicked ball has not left its hull yet."""

    def hold(self, place: int | None) -> None:
        """Make a robot the holder, or nobody.

        A ball that is carried lies a little in the hull; one that is drawn touches it.
        """
        is_carried = place is not None and self._is_carried(place)
        self._engine.let_through(place if is_carried else None)
        self.holding = place
        self._leaving = None

    def begin_anew(self, ball: BallState) -> None:
        """Make a checkpoint: nobody holds the ball, every kicker is charged, and a ball on the ground rolls."""
        self.hold(None)
        self._kickers.charge()
        if not self._free.is_in_air(ball.z, ball.vz):
            self._engine.move_ball((ball.vx, ball.vy, ball.vz), self._free.rolling_spin(ball.vx, ball.vy))

    def kickers_ready(self, tick: int) -> tuple[bool, ...]:
        """Per robot: its kicker can kick in this tick."""
        return self._kickers.ready(tick)

    def begin(
        self, tick: int, robots: tuple[RobotState, ...], ball: BallState, inputs: Sequence[AppliedInput]
    ) -> BallReport:
        """Decide possession and carry out kicks, at the beginning of a tick.

        Robots that dribble claim the ball, and those that kick. A kick is done now or refused now; none is kept.
        """
        report = BallReport()
        claims = [place for place, one in enumerate(inputs) if one.dribble or one.kick is not None]
        new = holder(claims, robots, ball, self._dribbles) if claims else None
        if new != self.holding:
            self.hold(None if new is not None and self._would_press(new) else new)
        for place in claims:
            if inputs[place].kick is None:
                continue
            try:
                self._launch(place, self._kick(tick, place, robots[place], ball, inputs[place]))
            except KickRefusedError as refusal:
                report.refused[place] = str(refusal)
                continue
            self._kickers.kicked(place, tick)
            report.kicked = place
            report.touches.append(place)
        return report

    def before_step(self, drives: Sequence[FieldDrive]) -> BodyState | None:
        """Move the ball as its holder does, or as ground and air do; a free ball, as it begins the step."""
        now = self._engine.ball_now()
        position, _, velocity, spin = now
        if self.holding is not None and self._is_overrun(self.holding, position):
            self.hold(None)
        if self.holding is not None:
            self._carry(self.holding, drives[self.holding], BallState(*position, *velocity))
            if not self._is_carried(self.holding):
                self._push(now)
            return None
        changed = self._free.sudden_change(position, velocity, spin)
        if changed is None:
            self._push(now)
            return now
        self._engine.move_ball(*changed)
        return now._replace(velocity=changed[0], spin=changed[1])

    def _push(self, ball: BodyState) -> None:
        """Ground and air push the ball in this step."""
        force = self._free.force(ball.position, ball.velocity, ball.spin)
        if force != (0.0, 0.0, 0.0):
            self._engine.push_ball(force, ball.position)

    def after_step(self, report: BallReport) -> None:
        """Note who touched the ball."""
        contacts: BallContacts = self._engine.ball_contacts(self.holding)
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

    def _kick(self, tick: int, place: int, robot: RobotState, ball: BallState, told: AppliedInput) -> Launch:
        """The velocity that this robot's kick gives the ball.

        Raises:
            KickRefusedError: it does not hold the ball, its kicker is not charged, or the kick leads nowhere.
        """
        if told.kick is None or place != self.holding:
            raise KickRefusedError(why_not_held(robot, ball, self._dribbles[place]))
        reason = self._kickers.why_not(place, tick)
        if reason is not None:
            raise KickRefusedError(reason)
        kicker = self._models[place].kicker
        return launch(told.kick.mode, Shot(told.kick.speed, ball, robot.heading, kicker, self._profile))

    def _launch(self, place: int, velocity: Launch) -> None:
        """Set the ball going, out of its kicker's hull; along the ground it rolls at once and keeps its exit speed."""
        vx, vy, vz = velocity
        self._engine.move_ball((vx, vy, vz), self._free.rolling_spin(vx, vy) if vz == 0.0 else (0.0, 0.0, 0.0))
        self._engine.let_through(place)
        self.holding, self._leaving = None, place

    def _leave(self, kicker: int) -> None:
        """Let a kicked ball collide with its kicker again as soon as it has left the hull."""
        robot, hull = self._engine.robot_now(kicker), self._models[kicker].body
        position, *_ = self._engine.ball_now()
        x, y, z = position
        touching = hull.reach + self._profile.ball.radius
        has_left = math.hypot(x - robot.x, y - robot.y) > touching or z > hull.height
        if has_left or self._is_overrun(kicker, position):
            self.hold(None)

    def _would_press(self, place: int) -> bool:
        """Whether the ball lies pressed into another body than the robot that would carry it.

        Carried to its place it would be pressed deeper, lost, and caught again in the next tick, each time deeper.
        """
        return self._is_carried(place) and self._engine.ball_contacts(place).depth > _PRESSED

    def _is_carried(self, place: int) -> bool:
        """Whether a robot moves the ball for certain, rather than draws it by forces."""
        return self._dribbles[place].method != "force"

    def _is_overrun(self, place: int, ball: Vector) -> bool:
        """Whether another body, or its own way, has brought the ball into the hull of who holds or kicked it."""
        robot, gap = self._engine.robot_now(place), self._dribbles[place].gap
        return math.hypot(ball[0] - robot.x, ball[1] - robot.y) < gap - _OVERRUN

    def _carry(self, place: int, drive: FieldDrive, ball: BallState) -> None:
        """Move the ball with its holder for one step."""
        dribble, engine = self._dribbles[place], self._engine
        hold = Hold(engine.robot_now(place), drive, ball, dribble, self._profile.ball.radius, self._step)
        at, velocity, force = WAYS[dribble.method](hold)
        if velocity is not None:
            spin = self._free.rolling_spin(velocity[0], velocity[1])
            if at is not None:
                engine.set_ball(at, velocity, spin)
            else:
                engine.move_ball(velocity, spin)
        if force is not None:
            engine.push_ball(force, (ball.x, ball.y, ball.z))
