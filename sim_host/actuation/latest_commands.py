"""The newest command of each robot becomes its input in every tick, until it is too old or too long the newest."""

from collections.abc import Container, Mapping
from typing import NamedTuple

from schemas.config.sections import Safety
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Command, Drive

_AT_REST = AppliedInput(Drive(), dribble=False)


class CommandLimits(NamedTuple):
    """For how long a command is in force, in ticks."""

    age: float
    """Most ticks since the sight that it answers."""
    silence: float
    """Ticks since it arrived after which it no longer counts, if one arrives in each tick."""

    @classmethod
    def of(cls, safety: Safety, tick: float) -> "CommandLimits":
        """The limits of a profile; `tick` is the length of a control tick in s."""
        return cls(safety.watchdog / tick, safety.silence / tick)


class LatestCommands:
    """The newest command of each robot, with a watchdog: a command older than its limit brakes the robot to rest.

    A command is as old as the sight that it answers, so that a burst of old commands after a broken link has no effect.
    A robot whose commands stop arriving brakes before that: a delay makes commands old, but does not make them rare.
    Those of a brain that thinks for several ticks are rare, so the pause between the last two is allowed once more.
    """

    def __init__(self, names: tuple[str, ...], limits: CommandLimits, still: tuple[str, ...] = ()) -> None:
        """Robots in `still` rest, whatever their commands."""
        self._names = names
        self._still = still
        self._limits = limits
        self._newest: dict[str, Command] = {}
        self._arrived: dict[str, int] = {}
        """Robot → the tick in which its newest command arrived."""
        self._pauses: dict[str, int] = {}
        """Robot → ticks without a command between its last two."""

    def with_roster(self, names: tuple[str, ...], limits: CommandLimits, still: tuple[str, ...]) -> "LatestCommands":
        """The commands for another roster or limits; robots that remain keep their last command."""
        successor = LatestCommands(names, limits, still)
        successor._newest = {name: command for name, command in self._newest.items() if name in names}
        successor._arrived = {name: tick for name, tick in self._arrived.items() if name in names}
        successor._pauses = {name: pause for name, pause in self._pauses.items() if name in names}
        return successor

    def inputs(
        self, tick: int, fresh: Mapping[str, Command], off_field: Container[str] = ()
    ) -> dict[str, AppliedInput]:
        """The inputs of this tick; a kick is part of the tick in which its command is fresh, and of no other.

        Robots off the field rest, whatever their commands.
        """
        self._newest.update(fresh)
        for name in fresh:
            self._pauses[name] = tick - self._arrived.get(name, tick - 1) - 1
            self._arrived[name] = tick
        return {name: _AT_REST if name in off_field else self._input(name, tick, name in fresh) for name in self._names}

    def _input(self, name: str, tick: int, is_fresh: bool) -> AppliedInput:
        command = self._newest.get(name)
        if command is None or name in self._still or tick - command.answers_tick > self._limits.age:
            return _AT_REST
        if not is_fresh and tick - self._arrived[name] - self._pauses[name] >= self._limits.silence:
            return _AT_REST
        if is_fresh:
            return AppliedInput(command.drive, command.dribble, command.kick, command.answers_tick)
        return AppliedInput(command.drive, command.dribble)
