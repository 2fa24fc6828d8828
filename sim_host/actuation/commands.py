"""From commands to inputs: the newest command of each robot counts, until it is too old."""

from collections.abc import Container, Mapping

from schemas.command import Command, Drive
from schemas.host import AppliedInput
from schemas.light import light_form

_Input = light_form(AppliedInput)
_REST = _Input(Drive(), dribble=False)


class Commands:
    """What each robot was last told, with the watchdog: a command older than its limit brakes the robot to rest.

    A command is as old as the sight it answers, so that a burst of stale ones after a broken link moves nobody.
    """

    def __init__(self, names: tuple[str, ...], watchdog_ticks: float, still: tuple[str, ...] = ()) -> None:
        """Robots that stand `still` rest, whatever they are told."""
        self._names = names
        self._still = still
        self._watchdog = watchdog_ticks
        self._standing: dict[str, Command] = {}

    def handed_on(self, names: tuple[str, ...], watchdog_ticks: float, still: tuple[str, ...]) -> "Commands":
        """For other robots or another limit: who stays has been told what it was told."""
        heir = Commands(names, watchdog_ticks, still)
        heir._standing = {name: command for name, command in self._standing.items() if name in names}
        return heir

    def inputs(
        self, tick: int, fresh: Mapping[str, Command], off_field: Container[str] = ()
    ) -> dict[str, AppliedInput]:
        """The inputs of this tick; a kick is part of the tick its command arrives in, and of no other.

        Robots off the field rest, whatever they are told.
        """
        self._standing.update(fresh)
        return {name: _REST if name in off_field else self._input(name, tick, name in fresh) for name in self._names}

    def _input(self, name: str, tick: int, is_fresh: bool) -> AppliedInput:
        command = self._standing.get(name)
        if command is None or name in self._still or tick - command.answers_tick > self._watchdog:
            return _REST
        if is_fresh:
            return _Input(command.drive, command.dribble, command.kick, command.answers_tick)
        return _Input(command.drive, command.dribble)
