"""The actions of a robot: a vector of numbers from −1 to 1 that becomes a command."""

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from robot_agent.sdk.contract import Briefing
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.radio import BallBelief, Radio
from schemas.messages.sight import Sight
from touchline.policy.entries import Entry, signed
from touchline.policy.groups import has_ball
from touchline.policy.interface import Interface

_FRESH = 0.1
"""s; a ball that was seen no longer ago is told to teammates."""
_COMMAND, _DRIVE, _KICK = Command(answers_tick=0), Drive(), Kick(mode=KickMode.GROUND, speed=1.0)
_RADIO, _BALL = Radio(), BallBelief(x=0.0, y=0.0)
"""What commands are made of by `replace`, which does not check them: numbers are cut off at the robot's limits."""


class Control:
    """The layout of a robot's actions, which its briefing determines."""

    def __init__(self, briefing: Briefing) -> None:
        """The entries that this robot of this match has.

        Raises:
            TouchlineError: a parameter of the team is no valid setting of a policy.
        """
        drive = briefing.setup.drive
        self._speed, self._turn = drive.max_speed, drive.max_turn_rate
        self._sideways, self._ball = drive.sideways, has_ball(briefing)
        self._kick = briefing.setup.kicker.max_ground_speed
        self.decision_ticks = Interface.of(briefing.parameters).decision_ticks
        """Control ticks from one decision to the next."""
        entries = [signed("vx", "m/s", self._speed, self._speed, "velocity along the kick axis")]
        if self._sideways:
            entries.append(signed("vy", "m/s", self._speed, self._speed, "velocity to the left"))
        entries.append(signed("omega", "rad/s", self._turn, self._turn, "turn rate, counter-clockwise"))
        if self._ball:
            power = f"speed of a kick: from 0 at -1 to the top speed of {self._kick:g} m/s at 1"
            entries.append(
                signed("kick", "1", 1.0, 1.0, "above 0 the robot kicks along the ground once it holds the ball")
            )
            entries.append(signed("power", "1", 1.0, 1.0, power))
            entries.append(signed("dribble", "1", 1.0, 1.0, "the dribbler is on above 0"))
        self.entries: tuple[Entry, ...] = tuple(entries)
        """One for each number, in order; all are from −1 to 1."""

    @property
    def names(self) -> list[str]:
        """Names of the entries, in order."""
        return [entry.name for entry in self.entries]

    def command(
        self,
        action: NDArray[np.floating],
        tick: int,
        *,
        off_field: bool = False,
        can_kick: bool = False,
        radio: Radio | None = None,
    ) -> Command:
        """The command for one tick while an action of shape (entries,) is in force; values beyond ±1 are cut off.

        Args:
            action: as the policy has decided.
            tick: that of the newest sight.
            off_field: the robot does not take part, and does nothing.
            can_kick: the robot holds the ball, and its kicker is charged.
            radio: the `message` with an action that is new.
        """
        if off_field:
            return replace(_COMMAND, answers_tick=tick)
        numbers = [min(1.0, max(-1.0, number)) for number in action.tolist()]
        vx, omega = numbers[0] * self._speed, numbers[1 + self._sideways] * self._turn
        vy = numbers[1] * self._speed if self._sideways else 0.0
        drive = replace(_DRIVE, vx=vx, vy=vy, omega=omega)
        if not self._ball:
            return replace(_COMMAND, answers_tick=tick, drive=drive, radio=radio)
        kicks, power, dribble = numbers[-3:]
        kick, speed = None, (power + 1.0) / 2.0 * self._kick
        if kicks > 0.0 and speed > 0.0 and can_kick:
            kick = replace(_KICK, speed=speed)
        return replace(_COMMAND, answers_tick=tick, drive=drive, dribble=dribble > 0.0, kick=kick, radio=radio)

    def action(self, command: Command) -> NDArray[np.float32]:
        """The action, shape (entries,), whose command is nearest to this one, for policies that imitate a brain.

        A kick of any kind is one along the ground with its speed. `kick` is −1 without a kick, and `power` 0; `dribble`
        is −1 where the dribbler is off. The action does not hold what the command sends by radio.
        """
        drive, kick = command.drive, command.kick
        numbers = [drive.vx / self._speed, drive.vy / self._speed, drive.omega / self._turn]
        if not self._sideways:
            del numbers[1]
        if self._ball:
            numbers += [-1.0, 0.0] if kick is None else [1.0, 2.0 * kick.speed / self._kick - 1.0]
            numbers.append(1.0 if command.dribble else -1.0)
        return np.clip(np.array(numbers, np.float32), -1.0, 1.0)

    def message(self, sight: Sight) -> Radio:
        """With a new action, the robot tells its teammates where it is, and where it has just seen the ball."""
        ball = sight.ball
        if ball is None or ball.age > _FRESH:
            return replace(_RADIO, self=sight.self)
        seen = replace(_BALL, x=ball.x, y=ball.y, vx=ball.vx, vy=ball.vy, age=ball.age)
        return replace(_RADIO, self=sight.self, ball=seen)
