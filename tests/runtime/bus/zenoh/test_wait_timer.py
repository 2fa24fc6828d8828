"""The timer that ends waits with an end: when it checks, and which readers."""

import math
import threading
from collections.abc import Iterator

import pytest

from runtime.bus.zenoh.wait_timer import WaitTimer
from runtime.process.clock import WallClock

SOON = 30.0
"""s; more than any of this takes."""
MOMENT = 0.05
"""s; how long a short wait lasts."""


class Reader:
    """Waits as readers of Zenoh's do, but for a wake-up alone."""

    def __init__(self, timer: WaitTimer, clock: WallClock, sleeps_through: int = 0) -> None:
        self.deadline = math.inf
        self.woken = threading.Event()
        self._timer, self._clock, self._left = timer, clock, sleeps_through

    def begin(self, timeout: float) -> None:
        self.woken.clear()
        self.deadline = self._clock.now() + timeout
        if self.deadline < self._timer.next_check_at:
            self._timer.check_now()

    def wake(self) -> None:
        assert self._clock.now() >= self.deadline
        self._left -= 1
        if self._left < 0:
            self.deadline = math.inf
            self.woken.set()


@pytest.fixture
def clock() -> WallClock:
    return WallClock()


@pytest.fixture
def timer(clock: WallClock) -> Iterator[WaitTimer]:
    timer = WaitTimer(clock)
    yield timer
    timer.stop()


def test_each_of_many_waits_is_ended_while_others_begin_and_end(timer: WaitTimer, clock: WallClock) -> None:
    readers = [Reader(timer, clock) for _ in range(8)]

    def wait_often(reader: Reader, timeout: float) -> None:
        for _ in range(50):
            reader.begin(timeout)
            if not reader.woken.wait(SOON):
                return
            ended.append(reader)

    ended: list[Reader] = []
    threads = [
        threading.Thread(target=wait_often, args=(reader, 0.001 * number)) for number, reader in enumerate(readers)
    ]
    for reader in readers:
        timer.add(reader)
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [ended.count(reader) for reader in readers] == [50] * 8


def test_a_reader_that_does_not_wake_is_woken_again(timer: WaitTimer, clock: WallClock) -> None:
    reader = Reader(timer, clock, sleeps_through=2)
    timer.add(reader)
    reader.begin(MOMENT)
    assert reader.woken.wait(SOON)


def test_the_timer_stops_while_a_reader_waits_without_end(timer: WaitTimer, clock: WallClock) -> None:
    reader = Reader(timer, clock)
    timer.add(reader)
    reader.begin(1e12)  # longer than a thread can wait
    leaving = threading.Thread(target=timer.stop)
    leaving.start()
    leaving.join(SOON)
    assert not leaving.is_alive() and not reader.woken.is_set()
