"""Reports that a recorder waits for its match at a host that does not play it."""

from collections.abc import Callable

from runtime.bus.contract import Bus
from runtime.bus.host_watch import HostWatch
from runtime.process.timing import REQUEST_S


def with_no_match_notice(
    bus: Bus, report: Callable[[str], None], should_stop: Callable[[], bool]
) -> Callable[[], bool]:
    """The function `should_stop`, which is called again and again; reports once if the host is missing for a while."""
    host, due_at = HostWatch(bus), bus.clock.now() + REQUEST_S
    is_done = False

    def look_and_ask() -> bool:
        nonlocal is_done
        if not is_done:
            host.update()
            is_late = bus.clock.now() >= due_at
            if is_late and not host.seen:
                report(f'waiting for match "{bus.match}", which the host does not play; is that its --match?')
            is_done = host.seen or is_late
        return should_stop()

    return look_and_ask
