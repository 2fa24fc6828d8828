"""Up to where what has come can be written."""

import pytest

from recordings.recorder.reorder_window import ReorderWindow

COMPLETE = 5_000_000_000
REORDERED = COMPLETE - 100_000_000
EVERYTHING = COMPLETE + 1
LOOKS_PER_S = 20


@pytest.fixture
def window() -> ReorderWindow:
    """One that has looked all the time, and has just written."""
    window = ReorderWindow(0.0)
    update(window, 0.0, 1.0, received=True)
    window.mark_written()
    return window


def update(window: ReorderWindow, begin: float, seconds: float, linked: bool = True, received: bool = False) -> float:
    """Look as often as a recorder does; when that ended."""
    for number in range(1, round(seconds * LOOKS_PER_S) + 1):
        window.update(begin + number / LOOKS_PER_S, linked=linked, received=received)
    return begin + seconds


def test_while_messages_come_those_of_the_newest_tenth_of_a_second_wait(window):
    assert window.limit(COMPLETE) == REORDERED


def test_when_nothing_comes_all_that_is_complete_is_written(window):
    update(window, 1.0, 0.4)
    assert window.limit(COMPLETE) == REORDERED
    update(window, 1.4, 0.2)
    assert window.limit(COMPLETE) == EVERYTHING


@pytest.mark.parametrize("stall", [0.6, 3.0, 3600.0])
def test_after_a_stall_nothing_is_written_until_every_topic_was_seen_to(window, stall):
    window.update(1.0 + stall, linked=True, received=True)
    assert window.limit(COMPLETE) == 0
    now = update(window, 1.0 + stall, 1.4, received=True)
    assert window.limit(COMPLETE) == 0
    update(window, now, 0.2, received=True)
    assert window.limit(COMPLETE) == REORDERED


def test_nothing_is_written_while_the_link_is_broken_nor_until_every_topic_was_seen_to(window):
    now = update(window, 1.0, 4.0, linked=False)
    assert window.limit(COMPLETE) == 0
    now = update(window, now, 1.4)
    assert window.limit(COMPLETE) == 0
    update(window, now, 0.2)
    assert window.limit(COMPLETE) == EVERYTHING


def test_a_machine_that_never_comes_to_rest_has_its_messages_written_all_the_same(window):
    now = 1.0
    for _ in range(25):
        now += 0.6
        window.update(now, linked=True, received=True)
    assert window.limit(COMPLETE) == REORDERED


def test_a_topic_that_has_ended_holds_the_others_back_for_half_a_minute_and_no_longer(window):
    now = update(window, 1.0, 29.0, received=True)
    assert window.limit(COMPLETE) == REORDERED
    now = update(window, now, 2.0, received=True)
    assert window.limit(COMPLETE) is None
    window.mark_written()
    assert window.limit(COMPLETE) == REORDERED
