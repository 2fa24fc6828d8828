"""What waits for a page, and how often frames are sent."""

import asyncio

import pytest

from coach_gateway.web.pages.frame_pace import FramePace
from coach_gateway.web.pages.send_queue import MOST, SendQueue


def drained(queue: SendQueue, count: int) -> list[str]:
    async def take() -> list[str]:
        return [await queue.next() for _ in range(count)]

    return asyncio.run(take())


def test_all_messages_wait_and_of_frames_the_newest_alone() -> None:
    queue = SendQueue()
    for number in range(5):
        queue.put_frame(f"frame {number}")
        queue.put(f"word {number}")
    assert drained(queue, 6) == [*(f"word {number}" for number in range(5)), "frame 4"]


def test_a_frame_of_before_the_welcome_is_not_sent_after_it() -> None:
    queue = SendQueue()
    queue.put("answer")
    queue.put_frame("old frame")
    queue.restart("welcome")
    queue.put_frame("new frame")
    assert drained(queue, 3) == ["answer", "welcome", "new frame"]


def test_the_queue_of_a_page_that_does_not_read_overflows() -> None:
    queue = SendQueue()
    for _ in range(MOST):
        queue.put("word")
    assert not queue.overflowed.is_set()
    queue.put("one more")
    assert queue.overflowed.is_set()
    assert drained(queue, MOST) == ["word"] * MOST


def shown(pace: FramePace, takes_s: float, seconds: float) -> int:
    """Number of frames sent when the server looks every 10 ms and each frame takes this long."""
    count, now = 0, 0.0
    while now < seconds:
        if pace.due(now):
            count += 1
            pace.took(takes_s)
            now += takes_s
        now += 0.01
    return count


@pytest.mark.parametrize(("takes_s", "least", "most"), [(0.0, 24, 26), (0.002, 24, 26), (0.025, 8, 13), (0.1, 2, 5)])
def test_frames_are_sent_twenty_five_times_a_second_unless_sending_takes_a_quarter_of_the_time(
    takes_s: float, least: int, most: int
) -> None:
    pace = FramePace()
    for _ in range(50):
        pace.took(takes_s)
    assert least <= shown(pace, takes_s, 1.0) <= most


def test_a_server_that_has_time_again_sends_as_often_as_before() -> None:
    pace = FramePace()
    for _ in range(50):
        pace.took(0.1)
    assert pace.period > 0.3
    for _ in range(50):
        pace.took(0.0)
    assert pace.period == 0.04
