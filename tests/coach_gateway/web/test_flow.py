"""What waits for a page, how often frames are told, and how much a page may say."""

import asyncio

import pytest

from coach_gateway.allowance import Allowance
from coach_gateway.web.outlet import MOST, Outlet
from coach_gateway.web.pace import FramePace


def drained(outlet: Outlet, count: int) -> list[str]:
    async def take() -> list[str]:
        return [await outlet.next() for _ in range(count)]

    return asyncio.run(take())


def test_of_frames_the_newest_alone_waits_and_of_words_all() -> None:
    outlet = Outlet()
    for number in range(5):
        outlet.show(f"frame {number}")
        outlet.say(f"word {number}")
    assert drained(outlet, 6) == [*(f"word {number}" for number in range(5)), "frame 4"]
    assert outlet.skipped == 4


def test_a_frame_of_before_the_welcome_is_not_sent_after_it() -> None:
    outlet = Outlet()
    outlet.say("answer")
    outlet.show("old frame")
    outlet.begin("welcome")
    outlet.show("new frame")
    assert drained(outlet, 3) == ["answer", "welcome", "new frame"]


def test_who_reads_nothing_overflows() -> None:
    outlet = Outlet()
    for _ in range(MOST):
        outlet.say("word")
    assert not outlet.overflows
    outlet.say("one more")
    assert outlet.overflows


def test_a_wait_ends_when_something_comes() -> None:
    async def waiting() -> str:
        outlet = Outlet()
        told = asyncio.create_task(outlet.next())
        await asyncio.sleep(0)
        outlet.show("frame")
        return await told

    assert asyncio.run(waiting()) == "frame"


def test_an_allowance_is_used_up_at_once_and_fills_up_with_time() -> None:
    allowance = Allowance(per_second=4.0, at_once=3.0, now=100.0)
    assert [allowance.take(100.0) for _ in range(4)] == [True, True, True, False]
    assert [allowance.take(100.25), allowance.take(100.25)] == [True, False]
    assert [allowance.take(200.0) for _ in range(4)] == [True, True, True, False]


def shown(pace: FramePace, takes_s: float, seconds: float) -> int:
    """How many frames are told when the server looks every 10 ms and each takes so long."""
    count, now = 0, 0.0
    while now < seconds:
        if pace.due(now):
            count += 1
            pace.took(takes_s)
            now += takes_s
        now += 0.01
    return count


@pytest.mark.parametrize(("takes_s", "least", "most"), [(0.0, 48, 51), (0.002, 45, 51), (0.025, 9, 13), (0.1, 2, 5)])
def test_frames_are_told_fifty_times_a_second_unless_telling_takes_a_quarter_of_the_time(
    takes_s: float, least: int, most: int
) -> None:
    pace = FramePace()
    shown(pace, takes_s, 5.0)
    fresh = FramePace()
    for _ in range(50):
        fresh.took(takes_s)
    assert least <= shown(fresh, takes_s, 1.0) <= most


def test_a_server_that_has_time_again_tells_as_often_as_before() -> None:
    pace = FramePace()
    for _ in range(50):
        pace.took(0.1)
    assert pace.period > 0.3
    for _ in range(50):
        pace.took(0.0)
    assert pace.period == 0.02
