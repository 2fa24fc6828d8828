"""Opens a client of a host that may start later: reports the wait, and can be interrupted."""

from collections.abc import Callable

from runtime.bus.contract import BusError
from runtime.bus.zenoh.bus import ZenohBus
from runtime.process.clock import Clock
from runtime.process.timing import SLICE_S


def open_when_there(
    open_client: Callable[[float], ZenohBus],
    clock: Clock,
    patience: float,
    report: Callable[[str], None],
    should_stop: Callable[[], bool] = lambda: False,
) -> ZenohBus | None:
    """The client that `open_client(patience)` opens, as soon as there is a host; None if `should_stop` became true.

    `report` receives one line if there is no host at once.

    Raises:
        BusError: there is no host for `patience` s of wall time.
    """
    deadline = clock.now() + patience
    reported = False
    while not should_stop():
        try:
            return open_client(min(SLICE_S, patience) if reported else 0.0)
        except BusError as error:
            if clock.now() >= deadline:
                raise
            if not reported:
                reported = True
                report(f"{error}; waiting for it for up to {patience:g} s")
    return None
