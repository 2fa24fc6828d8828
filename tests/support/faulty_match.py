"""A match of six robots on machines of their own, for faults that end well."""

from collections.abc import Callable

from support.machines import Machines
from support.process_story import Listener

CYAN = tuple(f"cyan{number}" for number in range(1, 6))
PATIENCE_S = 10.0
"""That of agents by default. Shorter than the time without a link in the longest cut, 12.5 s: an agent does not give up
a match from which it is cut off."""


class Match:
    """The match, and what its host publishes."""

    def __init__(self, field: Machines) -> None:
        self.field, self.net = field, field.net
        field.start_host()
        self.log: Listener = field.listen()
        for robot in CYAN:
            field.start_agent(robot, "cyan", PATIENCE_S)
        field.start_agent("magenta1", "magenta")
        self.until_playing(*CYAN, "magenta1")
        self.log.for_ticks(25)

    def until_playing(self, *robots: str, since: int = 0) -> int:
        """Receive until the commands of all these robots answer sights after tick `since`; returns the tick."""
        waiting = set(robots)

        def playing(log: Listener) -> int | None:
            for applied in log.applied[-10:]:
                for robot, command in applied.inputs.items():
                    if command.answers_tick is not None and command.answers_tick > since:
                        waiting.discard(robot)
            return None if waiting else log.tick

        try:
            tick: int = self.log.until(playing, f"commands of {robots}")
        except AssertionError as error:
            raise AssertionError("\n".join([str(error), *map(self._state_of, sorted(waiting))])) from None
        return tick

    def _state_of(self, robot: str) -> str:
        program = self.field.programs[robot]
        return f"{robot}: status {program.popen.poll()}, stderr: {program.err}"

    def after_fault(self, begin: Callable[[], None], ticks: int, end: Callable[[], None]) -> tuple[int, int]:
        """Let a fault last; returns the newest ticks at its beginning and at its end."""
        self.log.update()
        first = self.log.tick
        begin()
        self.log.for_ticks(ticks)
        last = self.log.tick
        end()
        return first, last
