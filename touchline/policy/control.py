"""The actions of a robot: a vector of numbers from −1 to 1 that becomes a command."""

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from robot_agent.sdk.contract import Briefing
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.radio import BallBelief, Radio
from schemas.messages.sight import Sight
from touchline.policy.entries import Entry, signed
from touchline.policy.groups import has_ball
from touchline.policy.interface import ACTS, Interface

_FRESH = 0.1
"""s; a ball that was seen no longer ago is told to teammates."""
_COMMAND, _DRIVE, _KICK = Command(answers_tick=0), Drive(), Kick(mode=KickMode.GROUND, speed=1.0)
_RADIO, _BALL = Radio(), BallBelief(x=0.0, y=0.0)
"""What commands are made of by `replace`, which does not check them: numbers are cut off at the robot's limits."""
_OVERRULES = 0.5
"""A correction of a yes or no beyond it, of either sign, decides instead of the brain."""

_COMMANDS = {
    "kick": "above 0 the robot kicks along the ground once it holds the ball",
    "power": "speed of a kick: from 0 at -1 to the top speed of {top:g} m/s at 1",
    "dribble": "the dribbler is on above 0",
}
_CORRECTIONS = {
    "kick": "above 0.5 the robot kicks once it holds the ball, below -0.5 it does not kick",
    "power": "added to the speed of a kick, the top speed of {top:g} m/s where only the policy kicks",
    "dribble": "the dribbler is on above 0.5, off below -0.5",
}
"""What the numbers mean in matches with a ball."""


class Control:
    """The layout of a robot's actions, which its briefing determines."""

    def __init__(self, briefing: Briefing) -> None:
        """The entries that this robot of this match has.

        Raises:
            TouchlineError: a parameter of the team is no valid setting of a policy.
        """
        drive = briefing.setup.drive
        self._speed, self._turn = drive.max_speed, drive.max_turn_rate
        self._kick = briefing.setup.kicker.max_ground_speed
        interface = Interface.of(briefing.parameters)
        self.decision_ticks = interface.decision_ticks
        """Control ticks from one decision to the next."""
        added = "added to the brain's " if interface.corrects else ""
        possible = [signed("vx", "m/s", self._speed, self._speed, f"{added}velocity along the kick axis")]
        if drive.sideways:
            possible.append(signed("vy", "m/s", self._speed, self._speed, f"{added}velocity to the left"))
        possible.append(signed("omega", "rad/s", self._turn, self._turn, f"{added}turn rate, counter-clockwise"))
        if has_ball(briefing):
            meanings = _CORRECTIONS if interface.corrects else _COMMANDS
            possible += [signed(name, "1", 1.0, 1.0, text.format(top=self._kick)) for name, text in meanings.items()]
        self.entries: tuple[Entry, ...] = tuple(entry for entry in possible if entry.name in interface.act)
        """One for each number, in order; all are from −1 to 1."""
        self.names = [entry.name for entry in self.entries]
        """Names of the entries, in order."""
        self._places = [ACTS.index(name) for name in self.names]
        if not self.entries:
            known = ", ".join(entry.name for entry in possible)
            raise TouchlineError(f"parameter act leaves {briefing.robot} no action; name some of {known}")

    def command(
        self,
        action: NDArray[np.floating],
        tick: int,
        *,
        off_field: bool = False,
        can_kick: bool = False,
        radio: Radio | None = None,
        corrected: Command | None = None,
    ) -> Command:
        """The command for one tick while an action of shape (entries,) is in force; values beyond ±1 are cut off.

        Args:
            action: as the policy has decided.
            tick: that of the newest sight.
            off_field: the robot does not take part, and does nothing.
            can_kick: the robot holds the ball, and its kicker is charged.
            radio: the `message` with an action that is new.
            corrected: the command of a brain, which zeros leave as it is; its own message is sent.
        """
        if off_field:
            return corrected or replace(_COMMAND, answers_tick=tick)
        numbers = [0.0] * len(ACTS)
        for place, number in zip(self._places, action.tolist(), strict=True):
            numbers[place] = min(1.0, max(-1.0, number))
        vx, vy, omega, kicks, power, dribble = numbers
        drive = replace(_DRIVE, vx=vx * self._speed, vy=vy * self._speed, omega=omega * self._turn)
        if corrected is not None:
            return self._correct(corrected, drive, (kicks, power, dribble), can_kick)
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
        numbers = {
            "vx": drive.vx / self._speed,
            "vy": drive.vy / self._speed,
            "omega": drive.omega / self._turn,
            "kick": -1.0 if kick is None else 1.0,
            "power": 0.0 if kick is None else 2.0 * kick.speed / self._kick - 1.0,
            "dribble": 1.0 if command.dribble else -1.0,
        }
        return np.clip(np.array([numbers[name] for name in self.names], np.float32), -1.0, 1.0)

    def _correct(self, command: Command, added: Drive, numbers: tuple[float, float, float], can_kick: bool) -> Command:
        """The command with velocities and the speed of its kick changed, and its yes or no overruled."""
        drive, kick, (kicks, power, dribble) = command.drive, command.kick, numbers
        made = replace(
            _DRIVE,
            vx=_sum(drive.vx, added.vx, self._speed),
            vy=_sum(drive.vy, added.vy, self._speed),
            omega=_sum(drive.omega, added.omega, self._turn),
        )
        if kicks > _OVERRULES and kick is None and can_kick:
            kick = replace(_KICK, speed=self._kick)
        if kick is not None:
            speed = _sum(kick.speed, power * self._kick, self._kick)
            kick = replace(kick, speed=speed) if speed > 0.0 and kicks >= -_OVERRULES else None
        dribbles = dribble > 0.0 if abs(dribble) > _OVERRULES else command.dribble
        return command.replace(drive=made, kick=kick, dribble=dribbles)

    def message(self, sight: Sight) -> Radio:
        """With a new action, the robot tells its teammates where it is, and where it has just seen the ball."""
        ball = sight.ball
        if ball is None or ball.age > _FRESH:
            return replace(_RADIO, self=sight.self)
        seen = replace(_BALL, x=ball.x, y=ball.y, vx=ball.vx, vy=ball.vy, age=ball.age)
        return replace(_RADIO, self=sight.self, ball=seen)


def _sum(given: float, added: float, limit: float) -> float:
    """A brain's number and its correction, which leads no farther beyond the limit than the brain is."""
    most = max(limit, abs(given))
    return min(most, max(-most, given + added)) if added else given
