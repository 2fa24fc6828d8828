from recordings.recorder.sequence_tracker import SequenceTracker
from runtime.bus.contract import Stamp

SECOND = 1_000_000_000


def count(*messages: tuple[int, int]):
    """The counts after messages given as (sequence, wall time of sending)."""
    tracker = SequenceTracker()
    for sequence, sent in messages:
        tracker.add(Stamp(sequence, sent, 0), 10)
    return tracker.count()


def test_an_unbroken_sequence_has_no_losses():
    found = count(*((n, n) for n in range(50)))
    assert (found.messages, found.bytes, found.lost, found.missed_before_start) == (50, 500, 0, 0)


def test_a_gap_is_lost():
    assert count((0, 0), (1, 1), (5, 5)).lost == 3


def test_a_late_message_is_not_lost_after_all():
    found = count((0, 0), (2, 2), (1, 1), (3, 3))
    assert (found.lost, found.late, found.duplicates) == (0, 1, 0)


def test_a_message_that_comes_twice_is_counted_as_doubled():
    found = count((0, 0), (1, 1), (1, 1), (2, 2))
    assert (found.lost, found.duplicates, found.restarts, found.messages) == (0, 1, 0, 4)


def test_a_writer_that_begins_again_has_lost_nothing():
    found = count((0, 0), (1, 1), (2, 2), (0, 9), (1, 10))
    assert (found.lost, found.restarts, found.duplicates) == (0, 1, 0)


def test_a_first_number_above_zero_was_missed_before_the_start():
    found = count((7, 7), (8, 8))
    assert (found.lost, found.missed_before_start) == (0, 7)


def test_a_number_that_the_writer_cannot_have_reached_is_another_writer_s():
    found = count((0, 0), (2**60, 1), (1, 2), (2**60 + 1, 3))
    assert (found.lost, found.restarts, found.missed_before_start) == (0, 1, 2**60)


def test_a_long_gap_is_lost_when_it_took_long():
    assert count((0, 0), (200_001, 100 * SECOND)).lost == 200_000


def test_two_writers_of_a_key_lose_nothing_by_taking_turns():
    found = count(*(message for n in range(500) for message in ((n + 3_000, 2 * n), (n, 2 * n + 1))))
    assert (found.messages, found.lost, found.restarts, found.duplicates, found.late) == (1000, 0, 1, 0, 0)


def test_one_of_two_writers_that_goes_on_after_seconds_of_silence_has_lost_nothing():
    found = count((3000, 0), (0, 1), (1, 2), (3001, 3 * SECOND), (2, 3 * SECOND + 1))
    assert (found.lost, found.restarts, found.late, found.duplicates) == (0, 1, 0, 0)


def test_what_one_of_two_writers_loses_is_lost_once():
    found = count((3000, 0), (0, 1), (3001, 2), (1, 3), (3002, 4), (4, 5), (3003, 6), (5, 7), (3006, 8))
    assert (found.lost, found.restarts) == (4, 1)


def test_a_restarted_writer_that_loses_messages_beside_its_former_numbers_has_lost_them():
    before, after = [(n, n) for n in range(100)], [(n, 2 * SECOND + n) for n in range(98)]
    found = count(*before, *after, (100, 2 * SECOND + 100), (101, 2 * SECOND + 101))
    assert (found.lost, found.restarts, found.duplicates) == (2, 1, 0)


def test_many_writers_of_a_key_cost_little_memory():
    tracker = SequenceTracker()
    for number in range(10_000):
        tracker.add(Stamp(0, number, 0), 1)
    found = tracker.count()
    assert (found.lost, found.restarts) == (0, 9_999)
    assert len(tracker._others) < 10
