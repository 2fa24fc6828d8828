"""The newest command of each robot becomes its input in every tick, until the watchdog finds it too old."""

from collections.abc import Container, Mapping

from schemas.messages.applied import AppliedInput
from schemas.messages.command import Command, Drive

_AT_REST = AppliedInput(Drive(), dribble=False)


class LatestCommands:
    """The newest command of each robot, with a watchdog: a command older than its limit brakes the robot to rest.

    A command is as old as the sight that it answers, so that a burst of old commands after a broken link has no effect.
    """

    def __init__(self, names: tuple[str, ...], watchdog_ticks: float, still: tuple[str, ...] = ()) -> None:
        """Robots in `still` rest, whatever their commands."""
        self._names = names
        self._still = still
        self._watchdog = watchdog_ticks
        self._newest: dict[str, Command] = {}

    def with_roster(self, names: tuple[str, ...], watchdog_ticks: float, still: tuple[str, ...]) -> "LatestCommands":
        """The commands for another roster or limit; robots that remain keep their last command."""
        successor = LatestCommands(names, watchdog_ticks, still)
        successor._newest = {name: command for name, command in self._newest.items() if name in names}
        return successor

    def inputs(
        self, tick: int, fresh: Mapping[str, Command], off_field: Container[str] = ()
    ) -> dict[str, AppliedInput]:
        """The inputs of this tick; a kick is part of the tick in which its command is fresh, and of no other.

        Robots off the field rest, whatever their commands.
        """
        self._newest.update(fresh)
        return {name: _AT_REST if name in off_field else self._input(name, tick, name in fresh) for name in self._names}

    def _input(self, name: str, tick: int, is_fresh: bool) -> AppliedInput:
        command = self._newest.get(name)
        if command is None or name in self._still or tick - command.answers_tick > self._watchdog:
            return _AT_REST
        if is_fresh:
            return AppliedInput(command.drive, command.dribble, command.kick, command.answers_tick)
        return AppliedInput(command.drive, command.dribble)
