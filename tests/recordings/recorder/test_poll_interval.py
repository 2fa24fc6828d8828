import pytest

from recordings.recorder.poll_interval import PollInterval


def intervals(*looks: tuple[float, int]) -> list[float]:
    """How long a recorder rests after looks given as (wall time, tick)."""
    interval = PollInterval(0.0)
    return [interval.next_poll(now, tick) - now for now, tick in looks]


def test_a_recorder_of_a_slow_match_waits_a_fifth_of_a_second():
    assert intervals((1.0, 49), (2.0, 99)) == pytest.approx([0.2, 0.2])


def test_a_recorder_of_a_fast_match_waits_until_sixty_ticks_have_come():
    assert intervals((1.0, 999), (1.1, 1199)) == pytest.approx([0.06, 0.03])


def test_a_recorder_of_a_match_that_stands_still_waits_no_longer():
    assert intervals((1.0, -1), (2.0, 400), (3.0, 400), (4.0, 0)) == pytest.approx([0.2, 0.15, 0.2, 0.2], abs=0.001)
