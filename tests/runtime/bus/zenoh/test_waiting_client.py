from typing import cast

import pytest

from runtime.bus.contract import BusError
from runtime.bus.zenoh.bus import ZenohBus
from runtime.bus.zenoh.waiting_client import open_when_there
from support.stepped_clock import SteppedClock

CLIENT = cast(ZenohBus, object())


class Host:
    """A host that is there from a moment on."""

    def __init__(self, from_s: float) -> None:
        self.clock = SteppedClock()
        self.lines: list[str] = []
        self._from = from_s

    def open_client(self, patience: float) -> ZenohBus:
        if self.clock.now() + patience < self._from:
            self.clock.sleep_until(self.clock.now() + patience)
            raise BusError("no host answers there")
        return CLIENT

    def wait(self, patience: float, stop_at: float = 1e9) -> ZenohBus | None:
        return open_when_there(
            self.open_client, self.clock, patience, self.lines.append, lambda: self.clock.now() >= stop_at
        )


def test_a_host_that_is_there_is_connected_to_without_a_line() -> None:
    host = Host(0.0)
    assert host.wait(30.0) is CLIENT
    assert (host.lines, host.clock.now()) == ([], 0.0)


def test_the_wait_for_a_host_is_reported_every_ten_seconds_with_what_is_left() -> None:
    host = Host(12.0)
    assert host.wait(30.0) is CLIENT
    assert host.lines == [f"no host answers there; waiting for it for up to {left} s" for left in (30, 20)]


@pytest.mark.parametrize(("patience", "most"), [(3.0, 3.5), (0.05, 0.06)])
def test_a_host_that_does_not_come_is_an_error_after_the_patience(patience: float, most: float) -> None:
    host = Host(1e9)
    with pytest.raises(BusError):
        host.wait(patience)
    assert patience <= host.clock.now() < most


def test_without_patience_nothing_is_waited_for() -> None:
    host = Host(1e9)
    with pytest.raises(BusError):
        host.wait(0.0)
    assert (host.lines, host.clock.now()) == ([], 0.0)


def test_a_wait_can_be_interrupted() -> None:
    host = Host(1e9)
    assert host.wait(30.0, stop_at=1.0) is None
    assert host.clock.now() < 1.5
