"""Up to where what has come can be written."""

import pytest

from recordings.holding import Holding

SETTLED = 5_000_000_000
IN_ORDER = SETTLED - 100_000_000
ALL_OF_IT = SETTLED + 1
LOOKS_PER_S = 20


@pytest.fixture
def holding() -> Holding:
    """One that has looked all the time, and has just written."""
    holding = Holding(0.0)
    look(holding, 0.0, 1.0, came=True)
    holding.written()
    return holding


def look(holding: Holding, begin: float, seconds: float, linked: bool = True, came: bool = False) -> float:
    """Look as often as a recorder does; when that ended."""
    for number in range(1, round(seconds * LOOKS_PER_S) + 1):
        holding.look(begin + number / LOOKS_PER_S, linked=linked, came=came)
    return begin + seconds


def test_while_messages_come_those_of_the_newest_tenth_of_a_second_wait(holding):
    assert holding.limit(SETTLED) == IN_ORDER


def test_when_nothing_comes_all_that_is_complete_is_written(holding):
    look(holding, 1.0, 0.4)
    assert holding.limit(SETTLED) == IN_ORDER
    look(holding, 1.4, 0.2)
    assert holding.limit(SETTLED) == ALL_OF_IT


@pytest.mark.parametrize("stall", [0.6, 3.0, 3600.0])
def test_after_a_stall_nothing_is_written_until_every_topic_was_seen_to(holding, stall):
    holding.look(1.0 + stall, linked=True, came=True)
    assert holding.limit(SETTLED) == 0
    now = look(holding, 1.0 + stall, 1.4, came=True)
    assert holding.limit(SETTLED) == 0
    look(holding, now, 0.2, came=True)
    assert holding.limit(SETTLED) == IN_ORDER


def test_nothing_is_written_while_the_link_is_broken_nor_until_every_topic_was_seen_to(holding):
    now = look(holding, 1.0, 4.0, linked=False)
    assert holding.limit(SETTLED) == 0
    now = look(holding, now, 1.4)
    assert holding.limit(SETTLED) == 0
    look(holding, now, 0.2)
    assert holding.limit(SETTLED) == ALL_OF_IT


def test_a_machine_that_never_comes_to_rest_has_its_messages_written_all_the_same(holding):
    now = 1.0
    for _ in range(25):
        now += 0.6
        holding.look(now, linked=True, came=True)
    assert holding.limit(SETTLED) == IN_ORDER


def test_a_topic_that_has_ended_holds_the_others_back_for_half_a_minute_and_no_longer(holding):
    now = look(holding, 1.0, 29.0, came=True)
    assert holding.limit(SETTLED) == IN_ORDER
    now = look(holding, now, 2.0, came=True)
    assert holding.limit(SETTLED) is None
    holding.written()
    assert holding.limit(SETTLED) == IN_ORDER
