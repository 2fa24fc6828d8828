"""Reports that a recorder waits for its match at a host that does not play it."""

from collections.abc import Callable

from recordings.timing import NO_MATCH_S
from runtime.bus.contract import Bus
from runtime.bus.host_watch import HostWatch


class NoMatchNotice:
    """Watches for the host of a match, and reports once if it is missing for a while."""

    def __init__(self, bus: Bus, report: Callable[[str], None]) -> None:
        self._match, self._clock, self._report = bus.match, bus.clock, report
        self._host = HostWatch(bus)
        self._due_at = self._clock.now() + NO_MATCH_S
        self._is_done = False

    def around(self, should_stop: Callable[[], bool]) -> Callable[[], bool]:
        """The function `should_stop`, which is called again and again; looks for the host, too."""

        def look_and_ask() -> bool:
            if not self._is_done:
                self._look()
            return should_stop()

        return look_and_ask

    def _look(self) -> None:
        self._host.update()
        is_late = self._clock.now() >= self._due_at
        if is_late and not self._host.seen:
            self._report(f'waiting for match "{self._match}", which the host does not play; is that its --match?')
        self._is_done = self._host.seen or is_late
