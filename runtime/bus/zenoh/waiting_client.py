"""Opens a client of a host that may start later: reports the wait, and can be interrupted."""

from collections.abc import Callable

from runtime.bus.contract import BusError
from runtime.bus.zenoh.bus import ZenohBus
from runtime.process.clock import Clock
from runtime.process.timing import RECONNECT_S, SLICE_S


def open_when_there(
    open_client: Callable[[float], ZenohBus],
    clock: Clock,
    patience: float,
    report: Callable[[str], None],
    should_stop: Callable[[], bool] = lambda: False,
) -> ZenohBus | None:
    """The client that `open_client(patience)` opens, as soon as there is a host; None if `should_stop` became true.

    `report` receives a line if there is no host at once, and again every `RECONNECT_S`.

    Raises:
        BusError: there is no host for `patience` s of wall time.
    """
    began = report_at = clock.now()
    attempt = 0.0
    while not should_stop():
        now = clock.now()
        try:
            return open_client(attempt)
        except BusError as error:
            if clock.now() >= began + patience:
                raise
            if now >= report_at:
                report_at = now + RECONNECT_S
                report(f"{error}; waiting for it for up to {began + patience - now:.0f} s")
            attempt = min(SLICE_S, patience)
    return None
