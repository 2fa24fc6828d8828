"""When a recorder takes its host for gone: a link that breaks is no farewell."""

from dataclasses import dataclass, field

import pytest

from recordings.recorder.host_watch import GRACE_S, HostWatch
from schemas.bus.in_process_bus import InProcessBus, Medium
from schemas.process.clock import SteppedClock


@dataclass
class Recorder:
    """A recorder's seat, whose link can break, and the host's token."""

    host: InProcessBus
    bus: InProcessBus
    linked: bool = True
    watch: HostWatch = field(init=False)

    def __post_init__(self) -> None:
        self.bus.connected = lambda: self.linked
        self.watch = HostWatch(self.bus)

    def break_link(self) -> None:
        """With the link goes all that was known through it."""
        self.linked = False
        self.host.withdraw_alive("host", "host")

    def take_host_for_gone(self, seconds: float, finished: bool = False) -> bool:
        """Whether it does so within this time, looking twenty times a second."""
        clock = self.bus.clock
        for _ in range(round(seconds * 20)):
            clock.sleep_until(clock.now() + 0.05)
            if self.watch.gone(finished):
                return True
        return False


@pytest.fixture
def recorder() -> Recorder:
    medium = Medium()
    host = medium.open_bus("friendly", SteppedClock())
    recorder = Recorder(host, medium.open_bus("friendly", SteppedClock()))
    host.declare_alive("host", "host")
    assert not recorder.take_host_for_gone(1.0)
    return recorder


def test_a_link_that_comes_back_in_time_is_no_farewell(recorder):
    recorder.break_link()
    assert not recorder.take_host_for_gone(GRACE_S - 1.0)
    recorder.linked = True
    assert not recorder.take_host_for_gone(0.5)  # the host's token follows the link, a moment later
    recorder.host.declare_alive("host", "host")
    assert not recorder.take_host_for_gone(2 * GRACE_S)


def test_a_host_that_does_not_come_back_is_gone(recorder):
    recorder.break_link()
    assert recorder.take_host_for_gone(GRACE_S + 1.0)


def test_after_a_finished_match_its_absence_is_its_farewell(recorder):
    assert not recorder.take_host_for_gone(1.0, finished=True)
    recorder.host.withdraw_alive("host", "host")
    assert recorder.take_host_for_gone(0.1, finished=True)


def test_a_recorder_that_stands_still_while_its_link_is_broken_gives_the_host_its_time_all_the_same(recorder):
    recorder.break_link()
    assert not recorder.take_host_for_gone(1.0)
    clock = recorder.bus.clock
    clock.sleep_until(clock.now() + 60.0)
    assert not recorder.take_host_for_gone(2.0)


def test_a_host_that_was_never_there_is_not_gone():
    recorder = Recorder(
        (medium := Medium()).open_bus("friendly", SteppedClock()), medium.open_bus("friendly", SteppedClock())
    )
    assert not recorder.take_host_for_gone(2 * GRACE_S)
