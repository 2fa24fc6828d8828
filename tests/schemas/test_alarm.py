"""Who ends waits that have an end: when it looks, and at whom."""

import math
import threading
from collections.abc import Iterator

import pytest

from schemas.bus.alarm import Alarm
from schemas.clock import WallClock

SOON = 30.0
"""s; more than any of this takes."""
MOMENT = 0.05
"""s; how long a short wait lasts."""


class Reader:
    """Waits as readers of Zenoh's do, but for a poke alone."""

    def __init__(self, alarm: Alarm, clock: WallClock, sleeps_through: int = 0) -> None:
        self.ends_at = math.inf
        self.woken = threading.Event()
        self.rang = 0
        """Waits that ended before the alarm would have looked."""
        self._alarm, self._clock, self._left = alarm, clock, sleeps_through

    def begin(self, timeout: float) -> None:
        self.woken.clear()
        self.ends_at = self._clock.now() + timeout
        if self.ends_at < self._alarm.looks_at:
            self.rang += 1
            self._alarm.ring()

    def poke(self) -> None:
        assert self._clock.now() >= self.ends_at
        self._left -= 1
        if self._left < 0:
            self.ends_at = math.inf
            self.woken.set()


@pytest.fixture
def clock() -> WallClock:
    return WallClock()


@pytest.fixture
def alarm(clock: WallClock) -> Iterator[Alarm]:
    alarm = Alarm(clock)
    yield alarm
    alarm.leave()


def test_a_wait_that_ends_before_all_others_is_ended_first(alarm: Alarm, clock: WallClock) -> None:
    long, short = Reader(alarm, clock), Reader(alarm, clock)
    alarm.watch(long)
    alarm.watch(short)
    long.begin(10 * SOON)
    for _ in range(3):
        short.begin(MOMENT)
        assert short.woken.wait(SOON)
    assert not long.woken.is_set()


def test_each_of_many_waits_is_ended_while_others_begin_and_end(alarm: Alarm, clock: WallClock) -> None:
    readers = [Reader(alarm, clock) for _ in range(8)]

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
        alarm.watch(reader)
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [ended.count(reader) for reader in readers] == [50] * 8


def test_a_wait_that_ends_later_than_the_alarm_looks_does_not_ring(alarm: Alarm, clock: WallClock) -> None:
    short, long = Reader(alarm, clock), Reader(alarm, clock)
    alarm.watch(short)
    alarm.watch(long)
    short.begin(SOON)
    while alarm.looks_at == math.inf:
        clock.sleep_until(clock.now() + 0.001)
    long.begin(2 * SOON)
    assert (short.rang, long.rang) == (1, 0)


def test_who_does_not_wake_is_poked_again(alarm: Alarm, clock: WallClock) -> None:
    reader = Reader(alarm, clock, sleeps_through=2)
    alarm.watch(reader)
    reader.begin(MOMENT)
    assert reader.woken.wait(SOON)


def test_the_alarm_leaves_while_somebody_waits_for_ever(alarm: Alarm, clock: WallClock) -> None:
    reader = Reader(alarm, clock)
    alarm.watch(reader)
    reader.begin(1e12)  # longer than a thread can be told to wait
    leaving = threading.Thread(target=alarm.leave)
    leaving.start()
    leaving.join(SOON)
    assert not leaving.is_alive() and not reader.woken.is_set()
